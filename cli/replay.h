#pragma once

#include "cli/verb.h"

namespace facescan {

/// facescan replay: bundles become meshes, pictures and reports.
Verb addReplay(CLI::App& app);

}  // namespace facescan
