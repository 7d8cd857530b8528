#include "reconstruct/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reconstruct/grids.h"

namespace facescan {
namespace {

using namespace test;

constexpr int kSide = 100;  // px

/// A scan of 100 × 100 px that is good unless a test says otherwise: stripes 4 px wide all over.
struct Findings {
    ScanDescription scan;
    PixelPlanes planes;
    VertexGrid grid = makeGrid(
        32, kSide, [](int code, int) { return code <= 25 ? 4.0 * code - 3 : std::nan(""); });
    StageFindings stages;
    Mesh mesh;

    Findings() {
        scan.image = {0, 0, kSide, kSide};
        scan.pattern.bits = 5;
        planes.width = planes.height = kSide;
        planes.modulation.assign(kSide * kSide, 120);
        stages.stripe_width_px = 4;
        stages.mm_per_px = 1.2f;
        stages.noise.grey_levels = 1;
        Vertex measured{};
        measured.quality = 0.7f;
        mesh.vertices.resize(40, measured);
        mesh.triangles.resize(60);
    }

    /// Sets the modulation of the pixels of the first `rows` rows.
    void darken(int rows, int level) {
        std::fill_n(planes.modulation.begin(), rows * kSide, std::uint8_t(level));
    }

    /// Leaves only the surface's first `codes` edges.
    void keepEdges(int codes) { cutHole(codes + 1, 0, 31 - codes, kSide, grid); }

    Report assess() {
        Report report;
        QualityScratch scratch;
        assessQuality(scan, planes, grid, stages, scratch, mesh, report);
        return report;
    }
};

TEST(Quality, OfAGoodScanIsGood) {
    const Report report = Findings().assess();
    EXPECT_EQ(report.verdict, Verdict::good);
    EXPECT_EQ(report.reason, Reason::none);
    EXPECT_EQ(report.lit_share, 1);
    EXPECT_EQ(report.saturated_share, 0);
    EXPECT_EQ(report.modulation_median, 120);
}

TEST(Quality, KnowsTheShareOfLitPixels) {
    Findings findings;
    findings.darken(30, 2);
    findings.darken(10, 0);
    EXPECT_DOUBLE_EQ(findings.assess().lit_share, 0.7);
}

TEST(Quality, TakesTheMedianModulationOfTheLitPixels) {
    Findings findings;
    findings.darken(60, 2);  // not lit
    std::fill_n(findings.planes.modulation.begin() + 60 * kSide, 25 * kSide, std::uint8_t(40));
    EXPECT_EQ(findings.assess().modulation_median, 40) << "25 rows of 40, 15 rows of 120";
}

TEST(Quality, KnowsTheShareOfTheLitPixelsThatIsCovered) {
    Findings findings;
    // 24 stripes of 4 px on 100 columns are covered.
    EXPECT_NEAR(findings.assess().coverage, 0.96, 0.01);
    findings.keepEdges(13);
    EXPECT_NEAR(findings.assess().coverage, 0.48, 0.01);
    findings.darken(40, 0);
    EXPECT_NEAR(findings.assess().coverage, 0.48 / 0.6, 0.01);
}

TEST(Quality, DoesNotAskForWhatLiesOutOfRange) {
    Findings findings;
    findings.keepEdges(13);
    findings.stages.out_of_range = 1000;  // edges of 4 px each
    EXPECT_NEAR(findings.assess().coverage, 0.48 / 0.6, 0.01);
}

TEST(Quality, GivesTheNoiseInMillimetres) {
    Findings findings;
    findings.stages.noise.grey_levels = 4;
    // At 40 grey levels a pixel, 0.1 px of 1.2 mm each.
    EXPECT_NEAR(findings.assess().noise_mm, 0.12, 1e-6);
}

TEST(Quality, CountsTheMesh) {
    Findings findings;
    for (int i = 0; i < 7; ++i) findings.mesh.vertices[i].quality = 0;
    const Report report = findings.assess();
    EXPECT_EQ(report.vertices_filled, 7);
    EXPECT_EQ(report.vertices_measured, 33);
    EXPECT_EQ(report.triangles, 60);
}

TEST(Quality, GivesTheMotionAlongTheImagesAxes) {
    for (const CodeAxis axis : {CodeAxis::x, CodeAxis::y}) {
        Findings findings;
        findings.scan.pattern.axis = axis;
        findings.stages.image_motions[1] = {.column = 0.6f, .y = -0.8f};
        findings.stages.motion.pairs[1].translation = {0.3f, 0, -0.4f};
        const Report report = findings.assess();
        const bool turned = axis == CodeAxis::x;
        EXPECT_FLOAT_EQ(report.motion[1].dx_px, turned ? -0.8f : 0.6f);
        EXPECT_FLOAT_EQ(report.motion[1].dy_px, turned ? 0.6f : -0.8f);
        EXPECT_FLOAT_EQ(report.motion[1].shift_mm, 0.5f);
        EXPECT_NEAR(report.motion_max_px, 1.0, 1e-6);
        EXPECT_NEAR(report.motion_max_mm, 0.5, 1e-6);
        EXPECT_EQ(report.motion[0].shift_mm, 0);
    }
}

struct Flaw {
    const char* name;
    void (*make)(Findings&);
    Reason reason;
};

void PrintTo(const Flaw& flaw, std::ostream* out) {
    *out << flaw.name;
}

class QualityFlaw : public testing::TestWithParam<Flaw> {};

TEST_P(QualityFlaw, IsNamed) {
    Findings findings;
    GetParam().make(findings);
    const Report report = findings.assess();
    EXPECT_NE(report.verdict, Verdict::good);
    EXPECT_EQ(report.reason, GetParam().reason) << describe(report.verdict, report.reason);
    EXPECT_FALSE(findings.mesh.triangles.empty()) << "there is a surface to show";
}

INSTANTIATE_TEST_SUITE_P(
    Flaws, QualityFlaw,
    testing::Values(Flaw{"Saturated", [](Findings& f) { f.planes.saturated = kSide * kSide / 4; },
                         Reason::over_exposed},
                    Flaw{"Moved",
                         [](Findings& f) {
                             f.stages.motion.pairs[0].translation = {4, 0, 0};
                         },
                         Reason::moved},
                    Flaw{"Noisy", [](Findings& f) { f.stages.noise.grey_levels = 20; },
                         Reason::noisy},
                    Flaw{"Faint", [](Findings& f) { f.darken(kSide, 14); }, Reason::low_contrast},
                    Flaw{"Gaps", [](Findings& f) { f.keepEdges(13); }, Reason::gaps},
                    Flaw{"Small", [](Findings& f) { f.keepEdges(2); }, Reason::too_little_surface}),
    testing::PrintToStringParamName());

TEST(Quality, AsksForARepetitionAfterALargeMotion) {
    Findings findings;
    findings.stages.motion.pairs[0].translation = {0, 30, 0};
    EXPECT_EQ(findings.assess().verdict, Verdict::repeat);
}

struct Absence {
    const char* name;
    void (*make)(Findings&);
    Reason reason;
};

void PrintTo(const Absence& absence, std::ostream* out) {
    *out << absence.name;
}

class QualityWithoutSurface : public testing::TestWithParam<Absence> {};

TEST_P(QualityWithoutSurface, EmptiesTheMeshAndSaysWhy) {
    Findings findings;
    cutHole(1, 0, 31, kSide, findings.grid);
    GetParam().make(findings);
    const Report report = findings.assess();
    EXPECT_EQ(report.verdict, Verdict::repeat);
    EXPECT_EQ(report.reason, GetParam().reason) << describe(report.verdict, report.reason);
    EXPECT_TRUE(findings.mesh.vertices.empty());
    EXPECT_TRUE(findings.mesh.triangles.empty());
    EXPECT_EQ(report.vertices_measured, 0);
    EXPECT_EQ(report.triangles, 0);
    EXPECT_EQ(report.coverage, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Causes, QualityWithoutSurface,
    testing::Values(Absence{"Dark", [](Findings& f) { f.darken(kSide, 0); }, Reason::dark},
                    Absence{"White",
                            [](Findings& f) {
                                f.darken(kSide, 0);
                                f.planes.saturated = kSide * kSide;
                            },
                            Reason::over_exposed},
                    Absence{"NoStripes", [](Findings&) {}, Reason::no_pattern}),
    testing::PrintToStringParamName());

}  // namespace
}  // namespace facescan
