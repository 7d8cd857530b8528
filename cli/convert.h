#pragma once

#include "cli/verb.h"

namespace facescan {

/// facescan convert: a mesh of ours in another file format.
Verb addConvert(CLI::App& app);

}  // namespace facescan
