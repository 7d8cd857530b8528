#include "cli/finished_scan.h"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "capture/bundle.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t kMaxReportBytes = 1 << 20;

/// Anything but an object where there is no whole report.
Json readReport(const fs::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    if (error || bytes > kMaxReportBytes) return {};
    std::ifstream stream(file, std::ios::binary);
    return Json::parse(stream, nullptr, false);
}

bool holds(const Json& report, const std::string& key, const Json& value) {
    const auto found = report.find(key);
    return found != report.end() && *found == value;
}

bool fulfils(const Json& report, const Json& request) {
    for (const auto& [key, value] : request.items()) {
        if (!holds(report, key, value)) return false;
    }
    return true;
}

/// Whether each file has as many bytes as the report says: a power cut may have cost some.
bool filesStand(const fs::path& folder, const Json& report) {
    const auto sizes = report.find("bytes");
    if (sizes == report.end() || !sizes->is_object()) return false;
    for (const auto& [name, size] : sizes->items()) {
        std::error_code error;
        const std::uintmax_t found = fs::file_size(folder / name, error);
        if (error || size != found) return false;
    }
    return true;
}

}  // namespace

Json finishedReport(const ReplayJob& job, const Json& request) {
    const Json report = readReport(job.folder / kReportName);
    const bool whole = report.is_object() && fulfils(report, request) &&
                       filesStand(job.folder, report) &&
                       holds(report, "input", toJson(readBundleFingerprint(job.bundle)));
    return whole ? report : Json();
}

}  // namespace facescan
