#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/bundle.h"
#include "cli/errors.h"
#include "cli/output_folders.h"
#include "cli/replay_plan.h"
#include "cli/scan_files.h"
#include "cli/stage_timer.h"
#include "render/preview.h"

namespace facescan {

/// What to make of each bundle.
struct ReplaySettings {
    Options options;
    std::vector<MeshFormat> formats;  ///< beside PLY
    bool preview = true;
    bool resume = false;  ///< leave alone what an earlier replay has finished
    Durability durability = Durability::synced;
};

struct ReplayTimes {
    double read_ms = 0;
    StageTimes stages_ms{};
    double reconstruct_ms = 0;  ///< frames in memory to finished mesh, texture and report
    double preview_ms = 0;
    double write_ms = 0;
};

/// How the replay of one bundle ended.
struct ReplayOutcome {
    ReplayJob job;
    int status = EX_OK;         ///< kNoSurface: there are results, but no mesh among them
    std::string error;          ///< one line where the status is not EX_OK
    std::string preview_error;  ///< why there is no picture, one line

    // Where an earlier replay has finished it: its report; the rest is left out.
    std::shared_ptr<const nlohmann::ordered_json> earlier_report;

    // Where there are results of this one:
    BundleFingerprint fingerprint;
    int bits = 0;
    Report report;
    ReplayTimes times;
    std::vector<std::string> files;  ///< names, in job.folder; the report is the last
    std::vector<std::size_t> sizes;  ///< of the files before the report, bytes

    bool hasResults() const { return status == EX_OK || status == kNoSurface; }
};

/// Replays bundles one after the other, and keeps memory and picture renderer from one to the next.
/// For one thread.
class Replayer {
public:
    Replayer(const ReplaySettings& settings, OutputFolders& folders);

    /// Reads, reconstructs and writes. All results of the bundle are written, or none.
    /// @param next  the bundle after it, which the system may read ahead; or an empty path
    ReplayOutcome replay(const ReplayJob& job, const std::filesystem::path& next);

private:
    bool isFinished(ReplayOutcome& outcome);
    void replayInto(ReplayOutcome& outcome, const std::filesystem::path& next);
    void noteNoMesh(ReplayOutcome& outcome, const std::string& verdict);
    void drawPreview(ReplayOutcome& outcome);
    void write(ReplayOutcome& outcome);

    const ReplaySettings& settings_;
    OutputFolders& folders_;
    nlohmann::ordered_json request_;
    ScanBundle bundle_;
    Workspace workspace_;
    Reconstruction result_;
    ScanFiles files_;
    std::optional<PreviewRenderer> renderer_;
    std::string no_renderer_;  ///< why there is none
};

}  // namespace facescan
