#include "cli/info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <ctime>
#include <memory>
#include <string>

#include "capture/bundle.h"
#include "capture/bundle_error.h"
#include "cli/bundle_name.h"
#include "cli/console.h"
#include "cli/errors.h"
#include "cli/report_json.h"
#include "cli/tables.h"

namespace facescan {
namespace {

constexpr const char* kExamples = R"(Examples:
  facescan info scans/anna
  facescan info scans/anna --json | jq .frames.count)";

struct InfoArguments {
    std::filesystem::path bundle;
    bool json = false;
};

std::string axisName(const Pattern& pattern) {
    return pattern.axis == CodeAxis::x ? "x" : "y";
}

std::string orderName(const Pattern& pattern) {
    return pattern.order == FrameOrder::grouped ? "grouped" : "interleaved";
}

/// "2026-03-01T12:00:00Z"
std::string startTime(const CaptureTiming& timing) {
    const auto seconds = std::time_t(timing.start_time_ns / 1'000'000'000);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(seconds));
}

std::string describeTiming(const CaptureTiming& timing) {
    const std::string start = timing.start_time_ns ? startTime(timing) : "start unknown";
    const std::string interval =
        timing.frame_interval_ns
            ? fmt::format("a frame every {:.3f} ms", double(timing.frame_interval_ns) / 1e6)
            : "interval unknown";
    return start + ", " + interval;
}

std::string infoTable(const std::filesystem::path& path, const ScanBundle& bundle) {
    const FrameStack& frames = bundle.frames;
    const ScanDescription& scan = bundle.description;
    const Calibration& calibration = scan.calibration;
    const int last = scan.first_frame + scan.pattern.frameCount() - 1;
    const std::pair<std::string, std::string> properties[] = {
        {"bundle", path.string()},
        {"frames",
         fmt::format("{} of {} x {} px, {} bytes a row; {} to {} carry the patterns", frames.count,
                     frames.width, frames.height, frames.row_stride, scan.first_frame, last)},
        {"image", fmt::format("{} x {} px at ({}, {})", scan.image.width, scan.image.height,
                              scan.image.x, scan.image.y)},
        {"pattern", fmt::format("Gray code of {} bits along {}, {}", scan.pattern.bits,
                                axisName(scan.pattern), orderName(scan.pattern))},
        {"calibration", fmt::format("polynomials of degree {}", calibration.degree)},
        {"range", fmt::format("{} to {} mm", calibration.range_min_mm, calibration.range_max_mm)},
        {"timing", describeTiming(bundle.timing)},
        {"sound", "yes"},
    };
    return propertyTable(properties);
}

Json infoJson(const std::filesystem::path& path, const ScanBundle& bundle) {
    const FrameStack& frames = bundle.frames;
    const ScanDescription& scan = bundle.description;
    const Rect& image = scan.image;
    const Pattern& pattern = scan.pattern;
    const Calibration& calibration = scan.calibration;
    return {
        {"version", FACESCAN_VERSION},
        {"bundle", path.string()},
        {"sound", true},
        {"frames",
         {{"count", frames.count},
          {"width", frames.width},
          {"height", frames.height},
          {"row_stride", frames.row_stride},
          {"first_pattern", scan.first_frame},
          {"patterns", pattern.frameCount()}}},
        {"image",
         {{"x", image.x}, {"y", image.y}, {"width", image.width}, {"height", image.height}}},
        {"pattern",
         {{"type", "gray"},
          {"bits", pattern.bits},
          {"axis", axisName(pattern)},
          {"order", orderName(pattern)}}},
        {"calibration",
         {{"degree", calibration.degree},
          {"range_min_mm", calibration.range_min_mm},
          {"range_max_mm", calibration.range_max_mm}}},
        {"timing",
         {{"start_time_ns", bundle.timing.start_time_ns},
          {"frame_interval_ns", bundle.timing.frame_interval_ns}}},
    };
}

int info(const InfoArguments& arguments) {
    requireBundle(arguments.bundle);
    try {
        const ScanBundle bundle = readBundle(arguments.bundle);
        print(arguments.json ? dump(infoJson(arguments.bundle, bundle)) + '\n'
                             : infoTable(arguments.bundle, bundle));
    } catch (const BundleError& error) {
        if (arguments.json)
            print(dump({{"version", FACESCAN_VERSION},
                        {"bundle", arguments.bundle.string()},
                        {"sound", false},
                        {"error", error.what()}}) +
                  '\n');
        throw;
    }
    return EX_OK;
}

}  // namespace

Verb addInfo(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command =
        app.add_subcommand("info", "Say what a recorded scan holds, and whether it is sound");
    command->add_option("BUNDLE", arguments->bundle, "folder of a recorded scan")
        ->required()
        ->type_name("");
    command->add_flag("--json", arguments->json, "print a JSON document");
    command->footer(kExamples);
    return {command, [arguments] { return info(*arguments); }};
}

}  // namespace facescan
