#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <variant>

#include "reconstruct/options.h"

namespace CLI {
class App;
}

namespace facescan {

/// How one of the stages' thresholds is asked for: --min-modulation LEVELS. A switch that is on
/// unless said otherwise is --smooth and --no-smooth.
struct StageOption {
    const char* name;  ///< of the option, without --; that of the field with - for _
    std::variant<bool Options::*, int Options::*, double Options::*> field;
    double min = 0;  ///< of numbers
    double max = 1;
    const char* unit = "";  ///< of numbers, as --help shows it
    const char* help = "";
};

/// One entry for each field of Options, in the order of the stages.
std::span<const StageOption> stageOptions();

/// Adds all of them to a verb. Values out of range are refused.
void addStageOptions(CLI::App& command, Options& options);

/// {"min_modulation": 6, …}
nlohmann::ordered_json toJson(const Options& options);

}  // namespace facescan
