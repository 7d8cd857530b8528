#pragma once

#include <filesystem>

#include "sim/render.h"

namespace facescan::sim {

/// Writes a simulated scan as a bundle (capture/bundle.h, whose conditions and errors hold).
void writeScan(const SimulatedScan& scan, const std::filesystem::path& folder);

}  // namespace facescan::sim
