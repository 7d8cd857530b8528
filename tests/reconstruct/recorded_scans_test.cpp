#include <gtest/gtest.h>

#include "reconstruct/mesh_topology.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/recorded_truth.h"

namespace facescan {
namespace {

using namespace test;

/// Bounds of the errors, mm. They are looser than those of tests/accuracy, which judges the
/// program by an evaluator of its own: these find what is broken, not what is less exact.
struct Limits {
    double rms;
    double percentile_95;
    double share_over_1mm = 0.0005;
    double filled_rms = 0.6;
};

Reconstruction reconstructRecorded(const std::string& name, const Options& options = {}) {
    const ScanBundle bundle = recordedScan(name);
    Workspace workspace;
    Reconstruction result;
    reconstruct(bundle.frames.view(), bundle.description, options, workspace, result);
    return result;
}

void expectWithin(const Limits& limits, const SurfaceError& error, int least_vertices) {
    EXPECT_GT(error.vertices, least_vertices);
    EXPECT_LT(error.rms, limits.rms);
    EXPECT_LT(error.percentile_95, limits.percentile_95);
    EXPECT_LE(error.share_over_1mm, limits.share_over_1mm);
    EXPECT_LT(error.filled_rms, limits.filled_rms);
}

void expectSoundMesh(const Reconstruction& result) {
    EXPECT_EQ(findFlaws(result.mesh), MeshFlaws{});
}

TEST(RecordedScan, OfAPlaneLiesOnThePlane) {
    const Reconstruction result = reconstructRecorded("plane_near");
    expectWithin({0.04, 0.08}, compare(result.mesh, recordedPlane()), 80000);
    expectSoundMesh(result);
}

TEST(RecordedScan, OfStepsKeepsTheirShape) {
    const Reconstruction result = reconstructRecorded("steps");
    expectWithin({0.055, 0.1}, compare(result.mesh, recordedSteps()), 65000);
    expectSoundMesh(result);
}

struct FaceScan {
    std::string name;
    Limits limits;
};

void PrintTo(const FaceScan& scan, std::ostream* out) {
    *out << scan.name;
}

class RecordedFace : public testing::TestWithParam<FaceScan> {};

TEST_P(RecordedFace, LiesOnTheTrueFace) {
    const auto& [name, limits] = GetParam();
    const Reconstruction result = reconstructRecorded(name);
    const FaceDepth face;
    const Eigen::Isometry3d pose = referencePose(name);
    const auto surface = [&](const Eigen::Vector3d& point) { return face.distance(point); };
    expectWithin(limits, compare(result.mesh, surface, pose), 15000);
    EXPECT_GT(face.coverage(result.mesh, pose), 0.94);
    expectSoundMesh(result);
}

INSTANTIATE_TEST_SUITE_P(Faces, RecordedFace,
                         testing::Values(FaceScan{"face_still", {0.045, 0.095}},
                                         FaceScan{"face_flipped", {0.045, 0.095}},
                                         FaceScan{"face_tremor", {0.08, 0.14}},
                                         FaceScan{"face_sideways", {0.15, 0.26}}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace facescan
