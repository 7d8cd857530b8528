#include "cli/simulate.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include "cli/bundle_name.h"
#include "cli/errors.h"
#include "cli/simulate_arguments.h"
#include "sim/truth.h"
#include "sim/write_scan.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

constexpr const char* kExamples = R"(Examples:
  facescan simulate scans/person7 --face 7
      the bundle scans/person7, its truth in scans/person7/truth
  facescan simulate shaky --face 7 --tremor-mm 0.3,0.3,0.3 --noise 2
  facescan simulate steps --scene steps --bits 9 --order grouped
  facescan simulate head --mesh head.ply --mesh-height-mm 260)";

struct SimulateTarget {
    fs::path folder;
    fs::path truth;  ///< empty: in the folder
    bool no_truth = false;
};

/// Said before the work, not after it.
void requireTarget(const fs::path& folder) {
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_empty(folder, ignored))
        throw CommandError(EX_CANTCREAT,
                           folder.string() + ": not empty; name a folder that is not there yet");
    const fs::path parent = fs::absolute(folder).lexically_normal().parent_path();
    if (!fs::is_directory(parent, ignored))
        throw CommandError(EX_CANTCREAT, parent.string() + ": no such folder");
}

sim::SimulatedScan scan(const SimulateArguments& arguments) {
    try {
        return sim::simulate(sceneOf(arguments), deviceOf(arguments), settingsOf(arguments));
    } catch (const std::invalid_argument& error) {
        throw CommandError(EX_USAGE, error.what());
    }
}

/// What sim/ throws where it cannot write becomes an error with a status.
template <typename Write>
void writeOrFail(const Write& write) {
    try {
        write();
    } catch (const std::runtime_error& error) {
        throw CommandError(EX_CANTCREAT, error.what());
    }
}

int simulate(const SimulateTarget& target, const SimulateArguments& arguments) {
    requireTarget(target.folder);
    const sim::SimulatedScan result = scan(arguments);
    writeOrFail([&] { sim::writeScan(result, target.folder); });
    if (target.no_truth) return EX_OK;
    const fs::path truth = target.truth.empty() ? target.folder / "truth" : target.truth;
    writeOrFail([&] { sim::writeTruth(result.truth, bundleName(target.folder), truth); });
    return EX_OK;
}

}  // namespace

Verb addSimulate(CLI::App& app) {
    auto target = std::make_shared<SimulateTarget>();
    auto arguments = std::make_shared<SimulateArguments>();
    CLI::App* command = app.add_subcommand("simulate", "Scan with a virtual scanner");
    command
        ->add_option("FOLDER", target->folder, "the bundle to be written; does not exist, or empty")
        ->required()
        ->type_name("");
    command->add_option("--truth", target->truth, "folder of the truth (default: FOLDER/truth)")
        ->type_name("DIR");
    command->add_flag("--no-truth", target->no_truth, "write the bundle alone");
    addSimulateArguments(*command, *arguments);
    command->footer(kExamples);
    return {command, [target, arguments] { return simulate(*target, *arguments); }};
}

}  // namespace facescan
