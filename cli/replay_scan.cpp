#include "cli/replay_scan.h"

#include "cli/bundle_name.h"
#include "cli/report_json.h"
#include "export/png.h"
#include "render/render_error.h"

namespace facescan {

ReplayOutcome Replayer::replay(const ReplayJob& job) {
    ReplayOutcome outcome;
    outcome.job = job;
    try {
        replayInto(outcome);
    } catch (...) {
        const ErrorReport error = describeError(std::current_exception());
        outcome.status = error.status;
        outcome.error = error.message;
    }
    return outcome;
}

void Replayer::replayInto(ReplayOutcome& outcome) {
    Stopwatch stopwatch;
    requireBundle(outcome.job.bundle);
    readBundle(outcome.job.bundle, bundle_);
    outcome.times.read_ms = stopwatch.lapMilliseconds();

    StageTimer timer;
    reconstruct(bundle_.frames.view(), bundle_.description, settings_.options, workspace_, result_,
                &timer);
    outcome.times.reconstruct_ms = stopwatch.lapMilliseconds();
    outcome.times.stages_ms = timer.times();
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

    if (!has_mesh) {
        outcome.status = kNoSurface;
        outcome.error = outcome.job.bundle.string() +
                        ": no mesh: " + describe(outcome.report.verdict, outcome.report.reason);
    }
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
    std::string& report = files_.add("report.json");
    outcome.files = files_.names();
    report = dump(reportJson(outcome, settings_.options), 2) + '\n';
    folders_.make(outcome.job.folder);
    try {
        files_.write(outcome.job.folder, settings_.durability);
    } catch (...) {
        folders_.removeIfEmpty(outcome.job.folder);
        throw;
    }
}

}  // namespace facescan
