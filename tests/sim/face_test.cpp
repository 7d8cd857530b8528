#include "sim/face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "sim/device.h"
#include "sim/ray_caster.h"
#include "sim/truth_maps.h"

namespace facescan::sim {
namespace {

constexpr double kCoarse = 3;

float nearest(const Scene& scene) {
    float z = 1e9f;
    for (const Eigen::Vector3f& p : scene.surface.positions) z = std::min(z, p.z());
    return z;
}

TEST(Face, IsTheSameForTheSameSeed) {
    const Scene a = makeFace(FaceParameters::fromSeed(4), kCoarse, 1);
    const Scene b = makeFace(FaceParameters::fromSeed(4), kCoarse, 3);
    EXPECT_EQ(a.surface.positions, b.surface.positions);
    EXPECT_EQ(a.surface.triangles, b.surface.triangles);
    EXPECT_TRUE(std::equal(a.surface.materials.begin(), a.surface.materials.end(),
                           b.surface.materials.begin(), [](const Material& m, const Material& n) {
                               return m.albedo == n.albedo && m.specular == n.specular;
                           }));
}

TEST(Face, DiffersFromSeedToSeed) {
    std::set<float> albedos, widths, noses;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const FaceParameters face = FaceParameters::fromSeed(seed);
        albedos.insert(face.skin_albedo);
        widths.insert(face.width);
        noses.insert(face.nose_length);
    }
    EXPECT_EQ(albedos.size(), 20u);
    EXPECT_EQ(widths.size(), 20u);
    EXPECT_EQ(noses.size(), 20u);
}

TEST(Face, SeedsCoverDarkAndLightSkinAllHairAndBeards) {
    std::set<HairStyle> hair;
    std::set<Beard> beards;
    float darkest = 1, lightest = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const FaceParameters face = FaceParameters::fromSeed(seed);
        hair.insert(face.hair);
        beards.insert(face.beard);
        darkest = std::min(darkest, face.skin_albedo);
        lightest = std::max(lightest, face.skin_albedo);
    }
    EXPECT_EQ(hair.size(), 3u);
    EXPECT_EQ(beards.size(), 3u);
    EXPECT_LT(darkest, 0.1f);
    EXPECT_GT(lightest, 0.5f);
}

TEST(Face, NoseTipIsWhereItIsAskedFor) {
    FaceParameters face;
    face.nose_distance_mm = 390;
    EXPECT_NEAR(nearest(makeFace(face, kCoarse)), 390, 1.5);
}

TEST(Face, HasTheProportionsOfAnAdult) {
    FaceParameters bald;
    bald.hair = HairStyle::bald;
    const Scene scene = makeFace(bald, kCoarse);
    float top = 1e9f, left = 1e9f, right = -1e9f;
    for (const Eigen::Vector3f& p : scene.surface.positions) {
        top = std::min(top, p.y());
        if (p.y() > -60 && p.y() < -30) {
            left = std::min(left, p.x());
            right = std::max(right, p.x());
        }
    }
    EXPECT_NEAR(-top, 112, 6) << "eyes to vertex";
    EXPECT_NEAR(right - left, 150, 10) << "breadth of the head";
}

TEST(Face, LiesInTheMeasurementRangeAndFillsThePicture) {
    const Device device = resized(standardDevice(), 60, 96);
    for (const std::uint64_t seed : {0, 1, 2, 3, 4, 5}) {
        const Scene scene = makeFace(FaceParameters::fromSeed(seed), kCoarse);
        const RayCaster caster(scene);
        const TruthMaps maps = castTruthMaps(caster, scene, device, 256, Pose{}, 0, 2);
        const auto in_range = std::count_if(maps.z.begin(), maps.z.end(), [&](float z) {
            return z > device.range_min_mm && z < device.range_max_mm;
        });
        EXPECT_GT(double(in_range) / double(maps.z.size()), 0.5) << "seed " << seed;
        EXPECT_GT(nearest(scene), device.range_min_mm);
    }
}

TEST(Face, ChinStandsBeforeTheNeckAcrossAGap) {
    const Scene scene = makeFace({}, kCoarse);
    const Device device = standardDevice();
    const RayCaster caster(scene);
    const TruthMaps maps = castTruthMaps(caster, scene, device, 256, Pose{}, 0, 2);
    float widest = 0;
    for (int y = 600; y < 760; ++y) {
        const std::size_t i = std::size_t(y) * 480 + 242;
        widest = std::max(widest, maps.z[i] - maps.z[i - 480]);
    }
    EXPECT_GT(widest, 15);
}

TEST(Face, SkinIsLighterThanBrowsAndHair) {
    const Scene scene = makeFace({}, 1.5);
    float darkest = 1, lightest = 0;
    for (const Material& material : scene.surface.materials) {
        darkest = std::min(darkest, material.albedo);
        lightest = std::max(lightest, material.albedo);
    }
    EXPECT_LT(darkest, 0.1f);
    EXPECT_GT(lightest, 0.45f);
    EXPECT_LT(lightest, 0.8f);
}

}  // namespace
}  // namespace facescan::sim
