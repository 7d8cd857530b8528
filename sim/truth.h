#pragma once

#include <filesystem>
#include <string>

#include "sim/render.h"

namespace facescan::sim {

/// Writes what is known of a scan into a folder, which is made if need be: truth.json, surface.npz
/// and maps.npz, as docs/simulator.md describes them. Throws std::runtime_error.
/// @param name  of the scan
void writeTruth(const Truth& truth, const std::string& name, const std::filesystem::path& folder);

}  // namespace facescan::sim
