#include <CLI/CLI.hpp>

#include "cli/errors.h"
#include "cli/simulate.h"

namespace facescan {

Verb addSimulate(CLI::App& app) {
    CLI::App* command = app.add_subcommand("simulate", "Scan with a virtual scanner (not built)");
    command->allow_extras();
    return {command, []() -> int {
                throw CommandError(EX_UNAVAILABLE,
                                   "simulate is not part of this build: it needs Embree 3");
            }};
}

}  // namespace facescan
