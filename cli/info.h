#pragma once

#include "cli/verb.h"

namespace facescan {

/// facescan info: what a recorded scan holds, and whether it is sound.
Verb addInfo(CLI::App& app);

}  // namespace facescan
