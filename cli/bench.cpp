#include "cli/bench.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/bundle_name.h"
#include "cli/console.h"
#include "cli/report_json.h"
#include "cli/stage_options.h"
#include "cli/tables.h"
#include "cli/validators.h"

namespace facescan {
namespace {

constexpr const char* kExamples = R"(Examples:
  facescan bench scans/anna
  facescan bench scans/anna --repeat 200 --json | jq .median_ms.total)";

struct BenchArguments {
    std::filesystem::path bundle;
    int repeat = 50;
    bool json = false;
    Options options;
};

struct Medians {
    StageTimes stages_ms{};
    double total_ms = 0;
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Reconstructs the scan again and again, in one thread, after one time that counts for nothing:
/// it takes the memory that the others reuse.
Medians measure(const ScanBundle& scan, const BenchArguments& arguments) {
    Workspace workspace;
    Reconstruction result;
    const FrameStackView frames = scan.frames.view();
    reconstruct(frames, scan.description, arguments.options, workspace, result);

    std::array<std::vector<double>, kStageCount> stages;
    std::vector<double> totals;
    for (int k = 0; k < arguments.repeat; ++k) {
        Stopwatch stopwatch;
        StageTimer timer;
        reconstruct(frames, scan.description, arguments.options, workspace, result, &timer);
        totals.push_back(stopwatch.lapMilliseconds());
        for (std::size_t stage = 0; stage < stages.size(); ++stage)
            stages[stage].push_back(timer.times()[stage]);
    }

    Medians medians{.total_ms = median(totals)};
    std::ranges::transform(stages, medians.stages_ms.begin(), median);
    return medians;
}

int bench(const BenchArguments& arguments) {
    requireBundle(arguments.bundle);
    const Medians medians = measure(readBundle(arguments.bundle), arguments);
    if (!arguments.json) {
        print(benchTable(medians.stages_ms, medians.total_ms));
        return EX_OK;
    }
    Json times = {{"total", rounded(medians.total_ms)}};
    times.update(toJson(medians.stages_ms));
    print(dump({{"version", FACESCAN_VERSION},
                {"bundle", arguments.bundle.string()},
                {"repeat", arguments.repeat},
                {"median_ms", times}}) +
          '\n');
    return EX_OK;
}

}  // namespace

Verb addBench(CLI::App& app) {
    auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand(
        "bench", "Median milliseconds of each stage, from frames in memory to mesh and report");
    command->add_option("BUNDLE", arguments->bundle, "folder of a recorded scan")
        ->required()
        ->type_name("");
    command->add_option("--repeat", arguments->repeat, "how often to reconstruct")
        ->check(wholeNumberFrom(1, 1'000'000))
        ->type_name("N")
        ->capture_default_str();
    command->add_flag("--json", arguments->json, "print a JSON document");
    addStageOptions(*command, arguments->options);
    command->footer(kExamples);
    return {command, [arguments] { return bench(*arguments); }};
}

}  // namespace facescan
