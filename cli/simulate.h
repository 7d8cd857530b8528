#pragma once

#include "cli/verb.h"

namespace facescan {

/// facescan simulate: a scan by the virtual scanner, with its truth. Where the simulator is not
/// built, the verb says so.
Verb addSimulate(CLI::App& app);

}  // namespace facescan
