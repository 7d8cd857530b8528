#include "sim/truth.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "sim/npz.h"

namespace facescan::sim {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Json rows(const Eigen::Matrix3d& m) {
    return {toJson(m.row(0)), toJson(m.row(1)), toJson(m.row(2))};
}

/// Three rows of four: rotation and translation.
Json toJson(const Pose& pose) {
    Json result = rows(pose.rotation);
    for (int i = 0; i < 3; ++i) result[i].push_back(pose.translation[i]);
    return result;
}

Json toJson(const Camera& c) {
    return {{"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx}, {"cy", c.cy},
            {"k1", c.k1}, {"k2", c.k2}, {"p1", c.p1}, {"p2", c.p2}};
}

Json toJson(const Projector& p) {
    return {{"R", rows(p.pose.rotation)},
            {"t", toJson(p.pose.translation)},
            {"centre", toJson(p.centre())},
            {"tan_x", p.tan_x},
            {"tan_y", p.tan_y},
            {"stripes_shown", p.stripes_shown},
            {"blur", p.blur},
            {"defocus", p.defocus},
            {"focus_mm", p.focus_mm},
            {"reference_mm", p.reference_mm},
            {"black", p.black}};
}

Json toJson(const Sensor& s) {
    return {{"gain", s.gain},
            {"pedestal", s.pedestal},
            {"electrons_per_level", s.electrons_per_level},
            {"read_noise_levels", s.read_noise_levels}};
}

Json toJson(const FitResidual& r) {
    return {{"rms_xyz", toJson(r.rms_xyz)},
            {"rms_3d", r.rms},
            {"max_3d", r.max},
            {"samples", r.samples}};
}

Json describe(const Truth& truth, const std::string& name) {
    const Device& device = truth.device;
    Json poses = Json::array(), reference_frames = Json::array();
    for (const Pose& pose : truth.poses) poses.push_back(toJson(pose));
    for (const TruthMaps& maps : truth.maps) reference_frames.push_back(maps.frame);
    const Rect& image = device.image;
    Json json = {
        {"name", name},
        {"kind", truth.kind},
        {"static", truth.still},
        {"width", device.camera.width},
        {"height", device.camera.height},
        {"crop", {image.x, image.y, image.width, image.height}},
        {"zrange", {device.range_min_mm, device.range_max_mm}},
        {"bits", truth.pattern.bits},
        {"axis", truth.pattern.axis == CodeAxis::x ? "x" : "y"},
        {"order", truth.pattern.order == FrameOrder::grouped ? "grouped" : "interleaved"},
        {"first", truth.first_frame},
        {"interval_s", device.frame_interval_s},
        {"ambient", device.ambient},
        {"lens_sigma_px", device.lens_sigma_px},
        {"camera", toJson(device.camera)},
        {"projector", toJson(device.projector)},
        {"sensor", toJson(device.sensor)},
        {"polynomial", toJson(truth.calibration_residual)},
        {"saturated_share", truth.saturated_share},
        {"reference_frames", reference_frames},
        {"poses", poses},
    };
    if (truth.sphere) {
        json["centre"] = toJson(truth.sphere->centre);
        json["radius"] = truth.sphere->radius;
    }
    return json;
}

void writeText(const std::filesystem::path& path, const std::string& text) {
    const std::filesystem::path temporary = path.string() + ".part";
    std::ofstream file(temporary, std::ios::binary);
    file << text << '\n';
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot write");
    std::filesystem::rename(temporary, path);
}

void writeSurface(const Surface& surface, const std::filesystem::path& path) {
    NpzWriter npz;
    const std::size_t vertices = surface.positions.size(), triangles = surface.triangles.size();
    npz.add("V", {vertices, 3},
            std::span(reinterpret_cast<const float*>(surface.positions.data()), 3 * vertices));
    npz.add(
        "F", {triangles, 3},
        std::span(reinterpret_cast<const std::uint32_t*>(surface.triangles.data()), 3 * triangles));
    npz.write(path);
}

void writeMaps(const Truth& truth, const std::filesystem::path& path) {
    const NpzWriter::Shape shape = {std::size_t(truth.device.camera.height),
                                    std::size_t(truth.device.camera.width)};
    NpzWriter npz;
    for (const TruthMaps& maps : truth.maps) {
        const std::string frame = std::to_string(maps.frame);
        npz.add("z" + frame, shape, maps.z);
        npz.add("cos_cam" + frame, shape, maps.cos_cam);
        npz.add("cos_proj" + frame, shape, maps.cos_proj);
        npz.addFlags("inside" + frame, shape, maps.inside);
        npz.add("hit" + frame, shape, maps.hit);
        npz.add("lit" + frame, shape, maps.lit);
    }
    npz.add("contrast", shape, truth.contrast);
    npz.write(path);
}

}  // namespace

void writeTruth(const Truth& truth, const std::string& name, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw std::runtime_error(folder.string() + ": cannot make: " + error.message());
    writeSurface(truth.surface, folder / "surface.npz");
    writeMaps(truth, folder / "maps.npz");
    writeText(folder / "truth.json", describe(truth, name).dump(1));
}

}  // namespace facescan::sim
