#include "cli/replay.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

#include "cli/batch.h"
#include "cli/bundle_list.h"
#include "cli/console.h"
#include "cli/errors.h"
#include "cli/interruption.h"
#include "cli/progress.h"
#include "cli/replay_plan.h"
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
  find scans -name scan.xml -printf '%h\n' | facescan replay --from - -o meshes --resume
      goes on where an interrupted replay stopped
  facescan replay scans/anna -o anna --json --max-hole-mm 5 | jq .quality)";

struct ReplayArguments {
    std::vector<std::string> bundles;
    fs::path list;
    fs::path folder;
    bool keep_paths = false;
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

/// The folders of a list's bundles do not depend on their number, so that lists may be split.
ReplayPlan makePlan(ReplayArguments& arguments) {
    const bool has_list = !arguments.list.empty();
    if (arguments.bundles.empty() && !has_list)
        throw CommandError(EX_USAGE,
                           "name bundles, or a list of them by --from; see facescan "
                           "replay --help");
    if (has_list) arguments.bundles = readBundleList(arguments.list);
    ResultFolder naming = ResultFolder::by_name;
    if (arguments.keep_paths)
        naming = ResultFolder::by_path;
    else if (arguments.bundles.size() == 1 && !has_list)
        naming = ResultFolder::itself;
    return {std::move(arguments.bundles), arguments.folder, naming};
}

/// Tells about each outcome, and makes up the exit status.
class ReplayTeller {
public:
    ReplayTeller(const ReplayArguments& arguments, std::size_t jobs)
        : arguments_(arguments),
          request_(requestJson(arguments.settings)),
          jobs_(jobs),
          progress_(jobs) {}

    void tell(const ReplayOutcome& outcome) {
        progress_.hide();
        if (arguments_.json)
            print(dump(outcomeJson(outcome, request_)) + '\n');
        else if (outcome.earlier_report)
            ++done_before_;
        else if (outcome.hasResults())
            print(jobs_ == 1 ? replayTable(outcome) : replayLine(outcome));
        if (!outcome.error.empty()) printError(outcome.error);
        if (!outcome.preview_error.empty() && !std::exchange(told_of_preview_, true))
            printError("no preview: " + outcome.preview_error);
        note(outcome.status);
        progress_.advance();
    }

    /// To be called once, at the end.
    void sumUp() {
        progress_.hide();
        if (done_before_ > 0) print(fmt::format("{} of {} done before\n", done_before_, jobs_));
    }

    int status() const { return status_; }

private:
    /// The first error counts, and a scan without a surface only where there is none.
    void note(int status) {
        const bool is_settled = status_ != EX_OK && status_ != kNoSurface;
        if (!is_settled && status != EX_OK) status_ = status;
    }

    const ReplayArguments& arguments_;
    const Json request_;
    std::size_t jobs_;
    std::size_t done_before_ = 0;
    Progress progress_;
    bool told_of_preview_ = false;
    int status_ = EX_OK;
};

int replay(ReplayArguments& arguments) {
    const ReplayPlan plan = makePlan(arguments);
    ReplaySettings& settings = arguments.settings;
    settings.preview = !arguments.no_preview;
    // Of many scans, to wait for the disk after each would cost more than to make the few again
    // that a power cut takes: --resume finds them by their sizes.
    settings.durability = plan.size() == 1 ? Durability::synced : Durability::buffered;

    OutputFolders folders;
    const auto make_worker = [&]() -> ReplayJobFunction {
        auto replayer = std::make_shared<Replayer>(settings, folders);
        return [&, replayer](std::size_t k) {
            const std::size_t next = k + std::size_t(arguments.threads);  // likely this thread's
            return replayer->replay(plan.job(k),
                                    next < plan.size() ? plan.job(next).bundle : fs::path());
        };
    };
    const Interruption interruption;
    ReplayTeller teller(arguments, plan.size());
    runBatch(
        plan.size(), arguments.threads, make_worker,
        [&](const ReplayOutcome& outcome) { teller.tell(outcome); }, Interruption::noted);
    teller.sumUp();
    return teller.status();
}

}  // namespace

Verb addReplay(CLI::App& app) {
    auto arguments = std::make_shared<ReplayArguments>();
    CLI::App* command = app.add_subcommand("replay", "Turn recorded scans into meshes");
    CLI::Option* bundles =
        command->add_option("BUNDLE", arguments->bundles, "folders of recorded scans")
            ->type_name("");
    command
        ->add_option("--from", arguments->list,
                     "file that lists the bundles, by lines or NULs; - is standard input")
        ->excludes(bundles)
        ->type_name("FILE");
    command
        ->add_option("-o,--output", arguments->folder,
                     "folder of the results; with several scans, each gets a folder in it")
        ->required()
        ->type_name("DIR");
    command->add_flag("--keep-paths", arguments->keep_paths,
                      "results in DIR/PATH, as the bundle is named, instead of DIR/NAME");
    command->add_flag("--resume", arguments->settings.resume,
                      "leave out scans whose results are there, whole and up to date");
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
