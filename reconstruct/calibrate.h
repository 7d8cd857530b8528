#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reconstruct/device_model.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/place_ranges.h"
#include "reconstruct/point.h"
#include "reconstruct/scan.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// The calibration, arranged for a walk over the vertex grid: the camera and projector behind its
/// polynomials where they can be recovered; else the polynomials, which for a given column and code
/// are univariate in the place y of the edge.
class GridCalibration {
public:
    static constexpr int kMaxDegree = 5;

    /// Prepares for a scan. Costs nothing where the scan before had the same calibration.
    /// @param recover_device  see recoverDevice
    void prepare(const ScanDescription& scan, int columns, bool recover_device);

    /// The point of the edge of a code in a column, at the place y (px in the stripe image).
    Point at(int code, int column, float y) const;
    /// The change of that point per pixel of y.
    Point slopeAt(int code, int column, float y) const;

    /// The points of `count` edges of a code, from the column `first` on.
    /// @param y      px; `shift` is added to each
    void row(int code, int first, int count, const float* y, float shift,
             const PointRow& points) const;

    /// Where the edges of a surface in the measurement range lie; everywhere where the device is
    /// not known.
    const PlaceRanges& placesInRange() const { return places_in_range_; }

private:
    void tabulatePolynomials();
    void findPlacesInRange();

    // What it is prepared for.
    std::optional<ScanDescription> scan_;
    int column_count_ = 0;
    bool recover_device_ = false;

    bool turned_ = false;         ///< the code changes along the image's x
    NormalisedInput across_;      ///< of the columns, from the crop's edge
    NormalisedInput along_;       ///< of y, likewise
    std::vector<float> columns_;  ///< normalised place of each column
    std::optional<DeviceModel> device_;
    std::vector<float> terms_;  ///< see PolynomialRow
    PlaceRanges places_in_range_;
};

/// Stage "calibrate": the point of every cell that is not empty, from (x, y, code). Points of empty
/// cells are void.
void calibrateCells(const GridCalibration& calibration, const VertexGrid& grid,
                    PointPlanes& points);

/// The points of filled cells alone; the other points stay.
void calibrateFilledCells(const GridCalibration& calibration, const VertexGrid& grid,
                          PointPlanes& points);

/// Empties the cells whose point lies outside the measurement range.
/// @param inside  scratch memory
/// @returns their number
int rejectOutOfRange(const Calibration& calibration, const PointPlanes& points,
                     std::vector<std::uint8_t>& inside, VertexGrid& grid);

}  // namespace facescan
