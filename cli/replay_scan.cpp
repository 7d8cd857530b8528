#include "cli/replay_scan.h"

#include "cli/bundle_name.h"
#include "cli/finished_scan.h"
#include "cli/report_json.h"
#include "export/png.h"
#include "render/render_error.h"

namespace facescan {

Replayer::Replayer(const ReplaySettings& settings, OutputFolders& folders)
    : settings_(settings), folders_(folders), request_(requestJson(settings)) {}

ReplayOutcome Replayer::replay(const ReplayJob& job, const std::filesystem::path& next) {
    ReplayOutcome outcome;
    outcome.job = job;
    try {
        requireBundle(job.bundle);
        if (!settings_.resume || !isFinished(outcome)) replayInto(outcome, next);
    } catch (...) {
        const ErrorReport error = describeError(std::current_exception());
        outcome.status = error.status;
        outcome.error = error.message;
    }
    return outcome;
}

bool Replayer::isFinished(ReplayOutcome& outcome) {
    removeLeftovers(outcome.job.folder);
    const Json report = finishedReport(outcome.job, request_);
    if (report.is_null()) return false;
    const bool has_mesh = report.at("bytes").contains(kMeshName);
    if (!has_mesh) noteNoMesh(outcome, report.at("quality").at("verdict"));
    outcome.earlier_report = std::make_shared<const Json>(report);
    return true;
}

void Replayer::noteNoMesh(ReplayOutcome& outcome, const std::string& verdict) {
    outcome.status = kNoSurface;
    outcome.error = outcome.job.bundle.string() + ": no mesh: " + verdict;
}

void Replayer::replayInto(ReplayOutcome& outcome, const std::filesystem::path& next) {
    Stopwatch stopwatch;
    readBundle(outcome.job.bundle, bundle_);
    if (!next.empty()) expectBundle(next);
    outcome.times.read_ms = stopwatch.lapMilliseconds();

    StageTimer timer;
    reconstruct(bundle_.frames.view(), bundle_.description, settings_.options, workspace_, result_,
                &timer);
    outcome.times.reconstruct_ms = stopwatch.lapMilliseconds();
    outcome.times.stages_ms = timer.times();
    outcome.fingerprint = bundle_.fingerprint;
    outcome.bits = bundle_.description.pattern.bits;
    outcome.report = result_.report;

    files_.clear();
    files_.addMesh(result_, settings_.formats);
    outcome.times.write_ms = stopwatch.lapMilliseconds();

    const bool has_mesh = !result_.mesh.triangles.empty();
    if (has_mesh && settings_.preview) drawPreview(outcome);
    outcome.times.preview_ms = stopwatch.lapMilliseconds();

    write(outcome);
    outcome.times.write_ms += stopwatch.lapMilliseconds();

    if (!has_mesh) noteNoMesh(outcome, describe(outcome.report.verdict, outcome.report.reason));
}

void Replayer::drawPreview(ReplayOutcome& outcome) {
    outcome.preview_error = no_renderer_;
    if (!no_renderer_.empty()) return;
    try {
        if (!renderer_) renderer_.emplace();
    } catch (const RenderError& error) {
        outcome.preview_error = no_renderer_ = error.what();
        return;
    }
    try {
        const RgbImage picture = renderer_->render(result_.mesh, result_.texture);
        files_.addPng("preview.png", {picture.pixels.data(), picture.width, picture.height, 3});
    } catch (const RenderError& error) {
        outcome.preview_error = error.what();
    }
}

void Replayer::write(ReplayOutcome& outcome) {
    outcome.sizes = files_.sizes();
    std::string& report = files_.add(kReportName);
    outcome.files = files_.names();
    report = dump(reportJson(outcome, request_), 2) + '\n';
    folders_.make(outcome.job.folder);
    try {
        files_.write(outcome.job.folder, settings_.durability);
    } catch (...) {
        folders_.removeIfEmpty(outcome.job.folder);
        throw;
    }
    folders_.keep(outcome.job.folder);
}

}  // namespace facescan
