#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/replay_scan.h"

// The documents of --json and report.json; facescan(1) describes them.

namespace facescan {

using Json = nlohmann::ordered_json;

/// What is asked for: the part of a report that all scans of a batch have in common.
Json requestJson(const ReplaySettings& settings);

/// report.json of a replayed scan. @param request  requestJson()
Json reportJson(const ReplayOutcome& outcome, const Json& request);

/// The line of `replay --json` for a bundle: its report, or its error.
Json outcomeJson(const ReplayOutcome& outcome, const Json& request);

/// {"scan_xml_crc32": "0x…", …}
Json toJson(const BundleFingerprint& fingerprint);

/// {"preprocess": 0.6, …}, in milliseconds
Json toJson(const StageTimes& times);

/// A measured value, to a thousandth: further digits say nothing.
double rounded(double value);

/// The document as text; bytes of a path that are no UTF-8 become U+FFFD.
/// @param indent  of nested lines; below 0: all on one line
std::string dump(const Json& json, int indent = -1);

}  // namespace facescan
