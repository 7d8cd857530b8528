#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "cli/bench.h"
#include "cli/console.h"
#include "cli/convert.h"
#include "cli/errors.h"
#include "cli/help_format.h"
#include "cli/info.h"
#include "cli/interruption.h"
#include "cli/replay.h"
#include "cli/simulate.h"

namespace facescan {
namespace {

constexpr const char* kExamples = R"(Examples:
  facescan replay scans/anna -o anna      a mesh, a picture and a report
  facescan info scans/anna                what a recording holds
  facescan convert anna/mesh.ply anna.glb
  facescan VERB --help                    options and examples of a verb

The manual, facescan(1), lists the exit statuses.)";

/// A pipe that is closed and a limit on file sizes are errors of writing, not ends of the process.
/// Mesa prints nothing by itself: what it lacks is told in our words.
void prepareProcess() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    setenv("EGL_LOG_LEVEL", "fatal", 0);
}

int runVerb(CLI::App& app, const std::vector<Verb>& verbs, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        const std::vector<CLI::App*> verb = app.get_subcommands();
        if (verb.empty() && argc < 2)
            throw CommandError(EX_USAGE, "say what to do; see facescan --help");
        if (verb.empty())
            throw CommandError(EX_USAGE, std::string(argv[1]) + " is no verb; see facescan --help");
        throw CommandError(EX_USAGE, std::string(error.what()) + "; see facescan " +
                                         verb.front()->get_name() + " --help");
    }
    for (const Verb& verb : verbs) {
        if (verb.command->parsed()) return verb.run();
    }
    return EX_SOFTWARE;
}

int run(int argc, char** argv) {
    CLI::App app("Turns recordings of a structured-light face scanner into meshes.", "facescan");
    app.set_version_flag("--version", "facescan " FACESCAN_VERSION);
    app.require_subcommand(1);
    app.footer(kExamples);
    app.formatter(std::make_shared<HelpFormat>());
    const std::vector<Verb> verbs = {addReplay(app), addBench(app), addInfo(app), addSimulate(app),
                                     addConvert(app)};
    for (const Verb& verb : verbs) verb.command->group("Verbs");
    const int status = runVerb(app, verbs, argc, argv);
    requireOutputTaken();
    Interruption::obey();
    return status;
}

}  // namespace
}  // namespace facescan

int main(int argc, char** argv) {
    facescan::prepareProcess();
    try {
        return facescan::run(argc, argv);
    } catch (...) {
        const facescan::ErrorReport error = facescan::describeError(std::current_exception());
        facescan::printError(error.message);
        return error.status;
    }
}
