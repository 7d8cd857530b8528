#include "sim/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/artefacts.h"
#include "sim/small_scan.h"
#include "sim/zip_member.h"

namespace facescan::sim {
namespace {

class TruthFolder : public testing::Test {
protected:
    TruthFolder() {
        ScanSettings settings{.bits = 4, .frames_before = 1, .samples_per_side = 2};
        settings.motion.drift_mm = {0, 0.5, 0};
        scan = simulate(makeSphere({.edge_mm = 3}), device, settings);
        writeTruth(scan.truth, "ball", folder);
        std::ifstream(folder / "truth.json") >> json;
    }

    std::vector<float> floats(const std::string& file, const std::string& name) const {
        const std::string bytes = zipMember(folder / file, name + ".npy");
        const std::size_t header = 10 + std::uint8_t(bytes[8]) + 256 * std::uint8_t(bytes[9]);
        std::vector<float> values((bytes.size() - header) / sizeof(float));
        std::memcpy(values.data(), bytes.data() + header, values.size() * sizeof(float));
        return values;
    }

    const Device device = smallQuietDevice();
    const std::filesystem::path folder = testing::TempDir() + "truth/ball";
    SimulatedScan scan;
    nlohmann::json json;
};

TEST_F(TruthFolder, NamesTheScanAndItsDevice) {
    EXPECT_EQ(json["name"], "ball");
    EXPECT_EQ(json["kind"], "sphere");
    EXPECT_EQ(json["static"], false);
    EXPECT_EQ(json["bits"], 4);
    EXPECT_EQ(json["order"], "interleaved");
    EXPECT_EQ(json["first"], 1);
    EXPECT_EQ(json["crop"], nlohmann::json({0, 4, 120, 188}));
    EXPECT_EQ(json["zrange"], nlohmann::json({300.0, 520.0}));
    EXPECT_DOUBLE_EQ(json["camera"]["fx"], 285);
    EXPECT_DOUBLE_EQ(json["projector"]["tan_y"], 0.38);
    EXPECT_EQ(json["radius"], 60);
    EXPECT_EQ(json["centre"], nlohmann::json({0.0, 0.0, 450.0}));
}

TEST_F(TruthFolder, HasAPoseForEveryFrame) {
    ASSERT_EQ(json["poses"].size(), 9u);
    EXPECT_EQ(json["poses"][1][0], nlohmann::json({1.0, 0.0, 0.0, 0.0}));
    EXPECT_NEAR(json["poses"][8][1][3], 0.5, 1e-12);
    EXPECT_EQ(json["reference_frames"], nlohmann::json({1, 8}));
}

TEST_F(TruthFolder, HasTheTrueMesh) {
    const std::vector<float> vertices = floats("surface.npz", "V");
    ASSERT_EQ(vertices.size(), 3 * scan.truth.surface.positions.size());
    EXPECT_EQ(vertices[3], scan.truth.surface.positions[1].x());
    EXPECT_NE(zipMember(folder / "surface.npz", "F.npy").find("'<u4'"), std::string::npos);
}

TEST_F(TruthFolder, HasTheMapsOfTheFirstAndTheLastFrame) {
    const std::size_t pixels = 120 * 192;
    for (const char* name : {"z1", "z8", "cos_cam1", "cos_proj8"}) {
        EXPECT_EQ(floats("maps.npz", name).size(), pixels) << name;
    }
    const std::size_t middle = pixelIndex(device, 60, 95);
    EXPECT_NEAR(floats("maps.npz", "z1")[middle], 390, 0.1);
    EXPECT_TRUE(std::isnan(floats("maps.npz", "z1")[0]));
    for (const char* name : {"inside1", "hit8", "lit1", "contrast"}) {
        EXPECT_GT(zipMember(folder / "maps.npz", std::string(name) + ".npy").size(), pixels);
    }
}

TEST_F(TruthFolder, CannotBeMadeUnderAFile) {
    EXPECT_THROW(writeTruth(scan.truth, "ball", folder / "truth.json" / "x"), std::runtime_error);
}

}  // namespace
}  // namespace facescan::sim
