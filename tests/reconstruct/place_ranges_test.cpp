#include "reconstruct/place_ranges.h"

#include <gtest/gtest.h>

#include "reconstruct/calibrate.h"
#include "reconstruct/pinhole_scanner.h"

namespace facescan {
namespace {

using namespace test;

class PlacesInRange : public testing::TestWithParam<CodeAxis> {};

TEST_P(PlacesInRange, HoldAllEdgesInRangeAndNoneFarOutside) {
    const PinholeScanner scanner{.axis = GetParam()};
    const ScanDescription scan = scanner.describe(FrameOrder::grouped, 300, 520);
    const bool turned = scanner.axis == CodeAxis::x;
    const int columns = turned ? scanner.height : scanner.width;
    const int rows = turned ? scanner.width : scanner.height;
    GridCalibration calibration;
    calibration.prepare(scan, columns, true);
    int inside = 0;
    int outside = 0;
    for (int code = 1; code < scan.pattern.stripes(); code += 3) {
        for (int column = 0; column < columns; column += 7) {
            for (int y = 0; y + 1 < rows; y += 3) {
                const bool may = calibration.placesInRange().mayHold(code, column, y);
                const float z = calibration.at(code, column, float(y) + 0.5f).z;
                if (z >= 300 && z <= 520) {
                    EXPECT_TRUE(may) << "code " << code << " at " << column << ", " << y;
                    ++inside;
                } else if (z < 280 || z > 600) {
                    EXPECT_FALSE(may) << "code " << code << " at " << column << ", " << y;
                    ++outside;
                }
            }
        }
    }
    EXPECT_GT(inside, 500);
    EXPECT_GT(outside, 500);
}

INSTANTIATE_TEST_SUITE_P(Axes, PlacesInRange, testing::Values(CodeAxis::x, CodeAxis::y));

TEST(PlaceRanges, HoldEverythingWhereTheDeviceIsNotKnown) {
    const PinholeScanner scanner;
    GridCalibration calibration;
    calibration.prepare(scanner.describe(FrameOrder::grouped, 300, 520), scanner.width, false);
    EXPECT_TRUE(calibration.placesInRange().mayHold(1, 0, 0));
    EXPECT_TRUE(calibration.placesInRange().mayHold(255, 159, 198));
}

}  // namespace
}  // namespace facescan
