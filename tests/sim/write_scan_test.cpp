#include "sim/write_scan.h"

#include <gtest/gtest.h>

#include "capture/bundle.h"
#include "sim/artefacts.h"
#include "sim/small_scan.h"

namespace facescan::sim {
namespace {

TEST(WriteScan, GivesABundleThatTheReaderTakes) {
    const std::filesystem::path folder = testing::TempDir() + "simulated";
    std::filesystem::remove_all(folder);
    const SimulatedScan scan =
        simulate(makePlane(), smallQuietDevice(),
                 {.bits = 5, .frames_after = 1, .row_padding = 3, .samples_per_side = 1});
    writeScan(scan, folder);
    const ScanBundle bundle = readBundle(folder);
    EXPECT_EQ(bundle.frames.pixels, scan.frames.pixels);
    EXPECT_EQ(bundle.frames.row_stride, 123);
    EXPECT_EQ(bundle.description.pattern, scan.description.pattern);
    EXPECT_EQ(bundle.description.image, scan.description.image);
    EXPECT_EQ(bundle.description.calibration.coefficients,
              scan.description.calibration.coefficients);
    EXPECT_NEAR(double(bundle.timing.frame_interval_ns), 1e9 / 60, 1);
}

}  // namespace
}  // namespace facescan::sim
