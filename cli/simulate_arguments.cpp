#include "cli/simulate_arguments.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "capture/frames_header.h"
#include "capture/numbers.h"
#include "cli/errors.h"
#include "cli/validators.h"
#include "sim/artefacts.h"
#include "sim/face.h"
#include "sim/mesh_file.h"

namespace facescan {
namespace {

Eigen::Vector3d vectorOf(const std::array<double, 3>& values) {
    return {values[0], values[1], values[2]};
}

/// "480x768"
std::pair<int, int> parseSize(const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto width = parseWholeNumber<int>(text.substr(0, cross));
    const auto height =
        cross == std::string::npos ? std::nullopt : parseWholeNumber<int>(text.substr(cross + 1));
    const auto isSide = [](int side) { return side >= kMinSide && side <= kMaxSide; };
    if (!width || !height || !isSide(*width) || !isSide(*height))
        throw CommandError(EX_USAGE, "--size: " + text + " is not a size such as 480x768, of " +
                                         std::to_string(kMinSide) + " to " +
                                         std::to_string(kMaxSide) + " pixels a side");
    return {*width, *height};
}

sim::Scene loadHead(const SimulateArguments& arguments, double distance_mm) {
    std::error_code ignored;
    if (!std::filesystem::exists(arguments.mesh, ignored))
        throw CommandError(EX_NOINPUT, arguments.mesh.string() + ": no such file");
    sim::MeshPlacement placement;
    placement.in_scanner_frame = arguments.mesh_as_is;
    placement.height_mm = arguments.mesh_height_mm;
    placement.nearest_mm = distance_mm;
    try {
        return sim::loadMesh(arguments.mesh, placement);
    } catch (const std::runtime_error& error) {
        throw CommandError(EX_DATAERR, error.what());
    }
}

sim::Scene makeFace(const SimulateArguments& arguments, double distance_mm) {
    auto face = sim::FaceParameters::fromSeed(arguments.face);
    face.nose_distance_mm = distance_mm;
    if (arguments.skin > 0) face.skin_albedo = float(arguments.skin);
    return sim::makeFace(face, 0.6, arguments.threads);
}

sim::Scene makeUprightScene(const SimulateArguments& arguments) {
    const auto distanceOr = [&](double usual_mm) {
        return arguments.distance_mm > 0 ? arguments.distance_mm : usual_mm;
    };
    if (!arguments.mesh.empty()) return loadHead(arguments, distanceOr(380));
    if (arguments.scene == "plane") return sim::makePlane({.distance_mm = distanceOr(400)});
    if (arguments.scene == "steps") return sim::makeSteps({.distance_mm = distanceOr(400)});
    if (arguments.scene == "sphere") return sim::makeSphere({.centre = {0, 0, distanceOr(450)}});
    return makeFace(arguments, distanceOr(380));
}

void addScene(CLI::App& command, SimulateArguments& arguments) {
    const std::string group = "What is scanned";
    command.add_option("--scene", arguments.scene, "what stands before the scanner")
        ->check(oneOf({"face", "plane", "sphere", "steps"}))
        ->type_name("face|plane|sphere|steps")
        ->capture_default_str()
        ->group(group);
    command.add_option("--face", arguments.face, "which face; 0 is the average")
        ->type_name("SEED")
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--skin", arguments.skin,
                    "how light the skin is, 0.06 very dark to 0.65 light (default: the face's own)")
        ->check(numberFrom(0.02, 0.95))
        ->type_name("ALBEDO")
        ->group(group);
    command.add_option("--mesh", arguments.mesh, "a head from a PLY or OBJ file instead, Y up")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--mesh-height-mm", arguments.mesh_height_mm,
                    "scale the head to this height (default: the file is in millimetres)")
        ->check(numberFrom(1, 10000))
        ->type_name("MM")
        ->group(group);
    command
        .add_flag("--mesh-as-is", arguments.mesh_as_is,
                  "the head stands in the scanner's frame already")
        ->group(group);
    command
        .add_option("--distance-mm", arguments.distance_mm,
                    "from the camera: of the nose, or the middle of a plane or sphere (default: "
                    "380 for heads, 450 for the sphere, 400 for the others)")
        ->check(numberFrom(50, 5000))
        ->type_name("MM")
        ->group(group);
}

void addDevice(CLI::App& command, SimulateArguments& arguments) {
    const std::string group = "The scanner";
    command.add_option("--device", arguments.device, "how its projector is mounted")
        ->check(oneOf({"standard", "upside-down"}))
        ->type_name("standard|upside-down")
        ->capture_default_str()
        ->group(group);
    command.add_option("--axis", arguments.axis, "the image axis along which the code changes")
        ->check(oneOf({"x", "y"}))
        ->type_name("x|y")
        ->capture_default_str()
        ->group(group);
    command.add_option("--size", arguments.size, "of its frames, upright (default: 480x768)")
        ->type_name("WIDTHxHEIGHT")
        ->group(group);
    command.add_option("--noise", arguments.noise, "times the usual noise of the sensor; 0: none")
        ->check(numberFrom(0, 100))
        ->type_name("FACTOR")
        ->capture_default_str()
        ->group(group);
    command.add_option("--ambient", arguments.ambient, "even light, a share of the projector's")
        ->check(numberFrom(0, 10))
        ->type_name("SHARE")
        ->capture_default_str()
        ->group(group);
}

void addScan(CLI::App& command, SimulateArguments& arguments) {
    const std::string group = "The scan";
    const auto add = [&](const char* name, auto& value, const char* help, const char* type) {
        return command.add_option(name, value, help)
            ->type_name(type)
            ->group(group)
            ->capture_default_str();
    };
    const auto addVector = [&](const char* name, auto& values, const char* help, const char* unit) {
        command.add_option(name, values, help)
            ->delimiter(',')
            ->check(numberFrom(-1000, 1000))
            ->type_name(unit)
            ->group(group);
    };
    add("--bits", arguments.bits, "of the Gray code", "N")
        ->check(wholeNumberFrom(kMinBits, kMaxBits));
    add("--order", arguments.order, "of the frames", "interleaved|grouped")
        ->check(oneOf({"interleaved", "grouped"}));
    add("--degree", arguments.degree, "of the fitted calibration", "N")
        ->check(wholeNumberFrom(1, 5));
    addVector("--drift-mm", arguments.drift_mm,
              "the hand's steady way, first frame to last (default: 0,0,0)", "X,Y,Z");
    addVector("--drift-deg", arguments.drift_deg, "its turn about each axis", "X,Y,Z");
    addVector("--tremor-mm", arguments.tremor_mm,
              "the hand's tremor: standard deviation along each axis", "X,Y,Z");
    addVector("--tremor-deg", arguments.tremor_deg, "the same, about each axis", "X,Y,Z");
    add("--seed", arguments.seed, "of noise and tremor", "N");
    add("--samples", arguments.samples, "rays a pixel: the square of this", "N")
        ->check(wholeNumberFrom(1, 16));
    command.add_option("--threads", arguments.threads, "(default: all cores)")
        ->check(wholeNumberFrom(1, 256))
        ->type_name("N")
        ->group(group);
}

}  // namespace

void addSimulateArguments(CLI::App& command, SimulateArguments& arguments) {
    addScene(command, arguments);
    addDevice(command, arguments);
    addScan(command, arguments);
}

sim::Device deviceOf(const SimulateArguments& arguments) {
    sim::Device device = sim::standardDevice();
    if (arguments.device == "upside-down") device = sim::withProjectorUpsideDown(device);
    if (!arguments.size.empty()) {
        const auto [width, height] = parseSize(arguments.size);
        device = sim::resized(device, width, height);
    }
    if (arguments.axis == "x") device = sim::sideways(device);
    device.ambient = arguments.ambient;
    device.sensor.read_noise_levels *= arguments.noise;
    // Shot noise: the variance is signal / electrons, and 0 electrons stand for none.
    const double variance = arguments.noise * arguments.noise;
    device.sensor.electrons_per_level =
        variance > 0 ? device.sensor.electrons_per_level / variance : 0;
    return device;
}

sim::ScanSettings settingsOf(const SimulateArguments& arguments) {
    sim::ScanSettings settings;
    settings.bits = arguments.bits;
    settings.order = arguments.order == "grouped" ? FrameOrder::grouped : FrameOrder::interleaved;
    settings.motion.drift_mm = vectorOf(arguments.drift_mm);
    settings.motion.drift_deg = vectorOf(arguments.drift_deg);
    settings.motion.tremor_mm = vectorOf(arguments.tremor_mm);
    settings.motion.tremor_deg = vectorOf(arguments.tremor_deg);
    settings.calibration_degree = arguments.degree;
    settings.samples_per_side = arguments.samples;
    settings.seed = arguments.seed;
    settings.threads = arguments.threads;
    return settings;
}

sim::Scene sceneOf(const SimulateArguments& arguments) {
    sim::Scene scene = makeUprightScene(arguments);
    return arguments.axis == "x" ? sim::turnedSideways(std::move(scene)) : scene;
}

}  // namespace facescan
