#include "cli/stage_options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>

#include "cli/validators.h"

namespace facescan {
namespace {

constexpr const char* kGroup = "Options of the stages";

constexpr std::array kStageOptions = {
    StageOption{"min-modulation", &Options::min_modulation, 1, 255, "LEVELS",
                "decode: a pixel whose grey level varies by less is not reached by the projector's "
                "light"},
    StageOption{"lens-blur-px", &Options::lens_blur_px, 0, 2, "PX",
                "motion: standard deviation of the camera's point spread, whose pull on the stripe "
                "edges is undone"},
    StageOption{.name = "compensate-motion",
                .field = &Options::compensate_motion,
                .help = "motion: move the vertices to the reference moment"},
    StageOption{"max-step-px", &Options::max_step_px, 0.01, 100, "PX",
                "filter: neighbours farther apart than this along the code's axis are not one "
                "surface"},
    StageOption{"end-columns", &Options::end_columns, 0, 8, "COLUMNS",
                "filter: so many columns at the end of a surface are placed by their neighbours"},
    StageOption{"min-component", &Options::min_component, 1, 1e6, "VERTICES",
                "filter: smaller connected pieces are no part of a face"},
    StageOption{.name = "smooth",
                .field = &Options::smooth,
                .help = "smooth: smooth the edge positions on the vertex grid"},
    StageOption{"outlier-sigmas", &Options::outlier_sigmas, 1, 100, "SIGMAS",
                "smooth: a larger residual, in standard deviations of the noise, is a false "
                "measurement"},
    StageOption{"noise-floor-px", &Options::noise_floor_px, 0, 10, "PX",
                "smooth: the noise is never taken for less"},
    StageOption{"max-residual-px", &Options::max_residual_px, 0.01, 100, "PX",
                "smooth: a larger residual is a false measurement however large the noise"},
    StageOption{.name = "recover-device",
                .field = &Options::recover_device,
                .help = "calibrate: use the camera and projector behind the polynomials where they "
                        "explain them"},
    StageOption{.name = "fill-holes",
                .field = &Options::fill_holes,
                .help = "fill: close holes inside the surface"},
    StageOption{"max-hole-mm", &Options::max_hole_mm, 0, 100, "MM",
                "fill: the largest hole that is closed"},
    StageOption{"max-rim-residual-px", &Options::max_rim_residual_px, 0, 100, "PX",
                "fill: a hole from whose rim a smooth surface is farther has a gap behind it"},
    StageOption{"max-edge-ratio", &Options::max_edge_ratio, 1, 1000, "RATIO",
                "tessellate: a face whose longest edge is this many times the mean spans a gap"},
    StageOption{"gamma", &Options::gamma, 0.1, 1, "EXPONENT",
                "texture: exponent of the gamma correction"},
};

void add(CLI::App& command, const StageOption& option, bool& value) {
    const std::string name = option.name;
    command
        .add_flag("--" + name + ",!--no-" + name, value,
                  fmt::format("{} [{}]", option.help, value ? "on" : "off"))
        ->group(kGroup);
}

CLI::Validator within(const StageOption& option, double) {
    return numberFrom(option.min, option.max);
}

CLI::Validator within(const StageOption& option, int) {
    return wholeNumberFrom(int(option.min), int(option.max));
}

template <typename Number>
void add(CLI::App& command, const StageOption& option, Number& value) {
    command
        .add_option(std::string("--") + option.name, value,
                    fmt::format("{} ({} to {})", option.help, option.min, option.max))
        ->check(within(option, value))
        ->type_name(option.unit)
        ->capture_default_str()
        ->group(kGroup);
}

}  // namespace

std::span<const StageOption> stageOptions() {
    return kStageOptions;
}

void addStageOptions(CLI::App& command, Options& options) {
    for (const StageOption& option : kStageOptions) {
        std::visit([&](auto field) { add(command, option, options.*field); }, option.field);
    }
}

nlohmann::ordered_json toJson(const Options& options) {
    nlohmann::ordered_json json;
    for (const StageOption& option : kStageOptions) {
        std::string key = option.name;
        std::ranges::replace(key, '-', '_');
        std::visit([&](auto field) { json[key] = options.*field; }, option.field);
    }
    return json;
}

}  // namespace facescan
