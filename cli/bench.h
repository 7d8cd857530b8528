#pragma once

#include "cli/verb.h"

namespace facescan {

/// facescan bench: milliseconds of each stage of a reconstruction.
Verb addBench(CLI::App& app);

}  // namespace facescan
