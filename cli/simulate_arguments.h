#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "sim/render.h"

namespace CLI {
class App;
}

namespace facescan {

/// What `simulate` is asked to scan, and how.
struct SimulateArguments {
    std::string scene = "face";  ///< face, plane, sphere or steps
    std::filesystem::path mesh;  ///< takes the scene's place where not empty
    double mesh_height_mm = 0;   ///< 0: the file is in millimetres
    bool mesh_as_is = false;
    std::uint64_t face = 0;
    double distance_mm = 0;  ///< 0: each scene's own
    double skin = 0;         ///< albedo; 0: the face's own

    std::string device = "standard";  ///< standard or upside-down
    std::string axis = "y";
    std::string size;  ///< "480x768"; empty: the device's own
    double noise = 1;  ///< factor of its standard deviation
    double ambient = sim::Device{}.ambient;

    int bits = 8;
    std::string order = "interleaved";
    int degree = 5;
    std::array<double, 3> drift_mm{};
    std::array<double, 3> drift_deg{};
    std::array<double, 3> tremor_mm{};
    std::array<double, 3> tremor_deg{};
    std::uint64_t seed = 1;
    int samples = 4;
    int threads = 0;  ///< 0: all cores
};

void addSimulateArguments(CLI::App& command, SimulateArguments& arguments);

// What they stand for. @throws CommandError

sim::Device deviceOf(const SimulateArguments& arguments);
sim::ScanSettings settingsOf(const SimulateArguments& arguments);
sim::Scene sceneOf(const SimulateArguments& arguments);

}  // namespace facescan
