#include "cli/replay.h"

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

#include "cli/batch.h"
#include "cli/bundle_name.h"
#include "cli/console.h"
#include "cli/interruption.h"
#include "cli/progress.h"
#include "cli/report_json.h"
#include "cli/stage_options.h"
#include "cli/tables.h"
#include "cli/validators.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxThreads = 256;

constexpr const char* kExamples = R"(Examples:
  facescan replay scans/anna -o anna
      turns a scan into anna/mesh.ply, texture.png, preview.png and report.json
  facescan replay scans/* -o meshes --format obj,glb --no-preview
      turns many into meshes/<name of the scan>/, on all cores
  facescan replay scans/anna -o anna --json --max-hole-mm 5 | jq .quality)";

struct ReplayArguments {
    std::vector<fs::path> bundles;
    fs::path folder;
    bool no_preview = false;
    bool json = false;
    int threads = int(std::max(1u, std::thread::hardware_concurrency()));
    ReplaySettings settings;
};

void addFormats(CLI::App& command, std::vector<MeshFormat>& formats) {
    const auto parse = [&formats](const std::vector<std::string>& names) {
        formats.clear();
        for (const std::string& name : names) {
            const std::optional<MeshFormat> format = parseMeshFormat(name);
            if (!format)
                throw CLI::ValidationError("--format", name + " is not one of ply, obj, stl, glb");
            formats.push_back(*format);
        }
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--format", parse, "further mesh formats, separated by commas; PLY is always written")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("ply,obj,stl,glb");
}

/// Where the results of each bundle go: with one, into the folder itself.
std::vector<ReplayJob> planJobs(const ReplayArguments& arguments) {
    const std::vector<std::string> names = distinctBundleNames(arguments.bundles);
    if (names.size() == 1) return {{arguments.bundles.front(), arguments.folder}};
    std::vector<ReplayJob> jobs;
    for (std::size_t k = 0; k < names.size(); ++k)
        jobs.push_back({arguments.bundles[k], arguments.folder / names[k]});
    return jobs;
}

/// Tells about each outcome, and makes up the exit status.
class ReplayTeller {
public:
    ReplayTeller(const ReplayArguments& arguments, std::size_t jobs)
        : arguments_(arguments), jobs_(jobs), progress_(jobs) {}

    void tell(const ReplayOutcome& outcome) {
        progress_.hide();
        if (arguments_.json)
            print(dump(outcomeJson(outcome, arguments_.settings.options)) + '\n');
        else if (outcome.hasResults())
            print(jobs_ == 1 ? replayTable(outcome) : replayLine(outcome));
        if (!outcome.error.empty()) printError(outcome.error);
        if (!outcome.preview_error.empty() && !std::exchange(told_of_preview_, true))
            printError("no preview: " + outcome.preview_error);
        note(outcome.status);
        progress_.advance();
    }

    int status() const { return status_; }

private:
    /// The first error counts, and a scan without a surface only where there is none.
    void note(int status) {
        const bool is_settled = status_ != EX_OK && status_ != kNoSurface;
        if (!is_settled && status != EX_OK) status_ = status;
    }

    const ReplayArguments& arguments_;
    std::size_t jobs_;
    Progress progress_;
    bool told_of_preview_ = false;
    int status_ = EX_OK;
};

int replay(ReplayArguments& arguments) {
    const std::vector<ReplayJob> jobs = planJobs(arguments);
    ReplaySettings& settings = arguments.settings;
    settings.preview = !arguments.no_preview;
    settings.durability = jobs.size() == 1 ? Durability::synced : Durability::buffered;

    OutputFolders folders;
    const auto make_worker = [&]() -> ReplayJobFunction {
        auto replayer = std::make_shared<Replayer>(settings, folders);
        return [&jobs, replayer](std::size_t job) { return replayer->replay(jobs[job]); };
    };
    const Interruption interruption;
    ReplayTeller teller(arguments, jobs.size());
    runBatch(
        jobs.size(), arguments.threads, make_worker,
        [&](const ReplayOutcome& outcome) { teller.tell(outcome); }, Interruption::noted);
    return teller.status();
}

}  // namespace

Verb addReplay(CLI::App& app) {
    auto arguments = std::make_shared<ReplayArguments>();
    CLI::App* command = app.add_subcommand("replay", "Turn recorded scans into meshes");
    command->add_option("BUNDLE", arguments->bundles, "folders of recorded scans")
        ->required()
        ->type_name("");
    command
        ->add_option("-o,--output", arguments->folder,
                     "folder of the results; with several scans, each gets a folder in it")
        ->required()
        ->type_name("DIR");
    addFormats(*command, arguments->settings.formats);
    command->add_flag("--no-preview", arguments->no_preview, "make no preview.png");
    command->add_flag("--json", arguments->json, "print a JSON document for each scan, one a line");
    command->add_option("--threads", arguments->threads, "scans at a time (default: all cores)")
        ->check(wholeNumberFrom(1, kMaxThreads))
        ->type_name("N");
    addStageOptions(*command, arguments->settings.options);
    command->footer(kExamples);
    return {command, [arguments] { return replay(*arguments); }};
}

}  // namespace facescan
