#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reconstruct/device_model.h"
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
    /// X, Y, Z and a fourth that stays 0: a register's width.
    using Outputs = std::array<float, 4>;

    /// Prepares for a scan. Costs nothing where the scan before had the same calibration.
    /// @param recover_device  see recoverDevice
    void prepare(const ScanDescription& scan, int columns, bool recover_device);

    /// The points of the edge of a code in a column, by its place.
    class Line {
    public:
        /// @param y  px in the stripe image
        Point at(float y) const;
        /// The change of the point per pixel of y.
        Point slopeAt(float y) const;

    private:
        friend class GridCalibration;
        const GridCalibration* calibration_ = nullptr;
        float across_ = 0;                                  ///< the column, normalised
        float code_ = 0;                                    ///< normalised
        std::array<Outputs, kMaxDegree + 1> coefficients_;  ///< by power of y
    };
    Line line(int code, int column) const;

private:
    /// Where the coefficient of y^j w^k stands in a column's table.
    static constexpr int termIndex(int j, int k) { return j * (13 - j) / 2 + k; }

    /// Coefficients of y^j w^k at a column, for the three outputs: w is the normalised code.
    using ColumnTable = std::array<Outputs, 21>;

    void tabulatePolynomials();

    // What it is prepared for.
    std::optional<ScanDescription> scan_;
    int column_count_ = 0;
    bool recover_device_ = false;

    bool turned_ = false;     ///< the code changes along the image's x
    NormalisedInput across_;  ///< of the columns, from the crop's edge
    NormalisedInput along_;   ///< of y, likewise
    std::optional<DeviceModel> device_;
    std::vector<ColumnTable> columns_;
};

/// Stage "calibrate": the point of every cell that is not empty, from (x, y, code); and, where
/// `slopes` is given, how it moves for a pixel of its edge. Both get the grid's size.
void calibrateCells(const GridCalibration& calibration, const VertexGrid& grid,
                    std::vector<Point>& points, std::vector<Point>* slopes = nullptr);

/// The same for filled cells alone; the other points stay.
void calibrateFilledCells(const GridCalibration& calibration, const VertexGrid& grid,
                          std::vector<Point>& points);

/// Empties the cells whose point lies outside the measurement range. @returns their number
int rejectOutOfRange(const Calibration& calibration, const std::vector<Point>& points,
                     VertexGrid& grid);

}  // namespace facescan
