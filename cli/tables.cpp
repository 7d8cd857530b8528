#include "cli/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/bundle_name.h"

namespace facescan {
namespace {

using Properties = std::vector<std::pair<std::string, std::string>>;

std::string timeLine(const char* name, double milliseconds) {
    return fmt::format("{:<12}{:>9.3f} ms\n", name, milliseconds);
}

std::string stageLines(const StageTimes& stages_ms) {
    std::string text;
    for (int stage = 0; stage < kStageCount; ++stage)
        text += timeLine(name(Stage(stage)), stages_ms[std::size_t(stage)]);
    return text;
}

Properties counts(const Report& report) {
    return {
        {"edges", fmt::format("{} found, {} decoded", report.edges_found, report.edges_decoded)},
        {"vertices", fmt::format("{} measured, {} filled, {} rejected", report.vertices_measured,
                                 report.vertices_filled, report.vertices_rejected)},
        {"triangles", fmt::format("{}", report.triangles)},
        {"holes", fmt::format("{} found, {} filled", report.holes_found, report.holes_filled)},
        {"coverage", fmt::format("{:.1f} %", 100 * report.coverage)},
        {"noise", fmt::format("{:.3f} mm", report.noise_mm)},
        {"motion",
         fmt::format("{:.2f} px, {:.2f} mm at most", report.motion_max_px, report.motion_max_mm)},
    };
}

const char* describeFile(const std::string& name) {
    if (name == "texture.png") return "texture";
    if (name == "preview.png") return "picture";
    if (name == "report.json") return "report";
    return name == "mesh.mtl" ? "material" : "mesh";
}

}  // namespace

std::string replayTable(const ReplayOutcome& outcome) {
    const ReplayTimes& times = outcome.times;
    std::string text = timeLine("read", times.read_ms) + stageLines(times.stages_ms);
    text += timeLine("preview", times.preview_ms) + timeLine("write", times.write_ms);
    text += timeLine("in all",
                     times.read_ms + times.reconstruct_ms + times.preview_ms + times.write_ms);
    text += fmt::format("({:.3f} ms from frames to mesh, texture and report)\n\n",
                        times.reconstruct_ms);

    Properties properties = counts(outcome.report);
    for (const std::string& file : outcome.files)
        properties.emplace_back(describeFile(file), (outcome.job.folder / file).string());
    text += propertyTable(properties);
    return text + '\n' + describe(outcome.report.verdict, outcome.report.reason) + '\n';
}

std::string replayLine(const ReplayOutcome& outcome) {
    return fmt::format("{}: {} triangles, {:.1f} ms. {}\n", bundleName(outcome.job.bundle),
                       outcome.report.triangles, outcome.times.reconstruct_ms,
                       describe(outcome.report.verdict, outcome.report.reason));
}

std::string benchTable(const StageTimes& stages_ms, double total_ms) {
    return stageLines(stages_ms) + timeLine("total", total_ms);
}

std::string propertyTable(std::span<const std::pair<std::string, std::string>> properties) {
    std::size_t width = 0;
    for (const auto& [name, text] : properties) width = std::max(width, name.size());
    std::string table;
    for (const auto& [name, text] : properties)
        table += fmt::format("{:<{}}  {}\n", name, width, text);
    return table;
}

}  // namespace facescan
