#include "cli/report_json.h"

#include <algorithm>
#include <cmath>

#include "capture/bundle_error.h"
#include "cli/stage_options.h"

namespace facescan {
namespace {

const char* name(Verdict verdict) {
    switch (verdict) {
        case Verdict::good:
            return "good";
        case Verdict::usable:
            return "usable";
        case Verdict::repeat:
            return "repeat";
    }
    return "";
}

const char* name(Reason reason) {
    switch (reason) {
        case Reason::none:
            return "none";
        case Reason::dark:
            return "dark";
        case Reason::over_exposed:
            return "over-exposed";
        case Reason::no_pattern:
            return "no pattern";
        case Reason::too_little_surface:
            return "too little surface";
        case Reason::low_contrast:
            return "low contrast";
        case Reason::moved:
            return "moved";
        case Reason::noisy:
            return "noisy";
        case Reason::gaps:
            return "gaps";
    }
    return "";
}

Json countsJson(const Report& report) {
    return {
        {"decode", {{"edges_found", report.edges_found}, {"edges_decoded", report.edges_decoded}}},
        {"filter", {{"vertices_rejected", report.vertices_rejected}}},
        {"fill",
         {{"holes_found", report.holes_found},
          {"holes_filled", report.holes_filled},
          {"vertices_filled", report.vertices_filled}}},
        {"tessellate",
         {{"vertices_measured", report.vertices_measured}, {"triangles", report.triangles}}},
    };
}

Json timesJson(const ReplayTimes& times) {
    Json json = {{"read", rounded(times.read_ms)}};
    json.update(toJson(times.stages_ms));
    json["reconstruct"] = rounded(times.reconstruct_ms);
    json["preview"] = rounded(times.preview_ms);
    return json;
}

Json motionJson(const Report& report, int bits) {
    Json pairs = Json::array();
    for (int pair = 0; pair < bits; ++pair) {
        const PairMotion& motion = report.motion[std::size_t(pair)];
        pairs.push_back({{"pair", pair},
                         {"dx_px", rounded(motion.dx_px)},
                         {"dy_px", rounded(motion.dy_px)},
                         {"shift_mm", rounded(motion.shift_mm)}});
    }
    return pairs;
}

Json qualityJson(const Report& report, int bits) {
    return {
        {"verdict", describe(report.verdict, report.reason)},
        {"grade", name(report.verdict)},
        {"reason", name(report.reason)},
        {"coverage", rounded(report.coverage)},
        {"lit_share", rounded(report.lit_share)},
        {"saturated_share", rounded(report.saturated_share)},
        {"modulation_median", rounded(report.modulation_median)},
        {"holes_found", report.holes_found},
        {"holes_filled", report.holes_filled},
        {"noise_mm", rounded(report.noise_mm)},
        {"motion_max_px", rounded(report.motion_max_px)},
        {"motion_max_mm", rounded(report.motion_max_mm)},
        {"motion", motionJson(report, bits)},
    };
}

}  // namespace

Json toJson(const StageTimes& times) {
    Json json = Json::object();
    for (int stage = 0; stage < kStageCount; ++stage)
        json[name(Stage(stage))] = rounded(times[std::size_t(stage)]);
    return json;
}

Json toJson(const BundleFingerprint& fingerprint) {
    return {{"scan_xml_crc32", hexWord(fingerprint.document_crc)},
            {"frames_header_crc32", hexWord(fingerprint.frames_header_crc)}};
}

Json requestJson(const ReplaySettings& settings) {
    Json formats = Json::array();
    for (const MeshFormat format :
         {MeshFormat::ply, MeshFormat::obj, MeshFormat::stl, MeshFormat::glb}) {
        const bool wanted = format == MeshFormat::ply ||
                            std::ranges::find(settings.formats, format) != settings.formats.end();
        if (wanted) formats.push_back(name(format));
    }
    return {{"version", FACESCAN_VERSION},
            {"options", toJson(settings.options)},
            {"formats", formats},
            {"preview", settings.preview}};
}

Json reportJson(const ReplayOutcome& outcome, const Json& request) {
    Json bytes = Json::object();
    for (std::size_t k = 0; k < outcome.sizes.size(); ++k)
        bytes[outcome.files[k]] = outcome.sizes[k];
    return {
        {"version", request["version"]},
        {"bundle", outcome.job.bundle.string()},
        {"input", toJson(outcome.fingerprint)},
        {"options", request["options"]},
        {"formats", request["formats"]},
        {"preview", request["preview"]},
        {"counts", countsJson(outcome.report)},
        {"milliseconds", timesJson(outcome.times)},
        {"quality", qualityJson(outcome.report, outcome.bits)},
        {"files", outcome.files},
        {"bytes", bytes},
    };
}

Json outcomeJson(const ReplayOutcome& outcome, const Json& request) {
    Json json;
    if (outcome.earlier_report)
        json = *outcome.earlier_report;
    else if (outcome.hasResults())
        json = reportJson(outcome, request);
    else
        json = {{"version", FACESCAN_VERSION}, {"bundle", ""}, {"error", outcome.error}};
    json["bundle"] = outcome.job.bundle.string();
    json["folder"] = outcome.job.folder.string();
    json["status"] = outcome.status;
    return json;
}

double rounded(double value) {
    return std::round(value * 1000) / 1000;
}

std::string dump(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace facescan
