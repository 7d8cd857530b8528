#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reconstruct/pattern.h"
#include "reconstruct/point.h"
#include "reconstruct/window.h"

namespace facescan {

/// A row of the pixel planes, as pairs of frames are added to it.
struct PixelRow {
    std::uint16_t* stripe;      ///< number of the stripe, as far as the pairs so far tell it
    std::uint16_t* brightness;  ///< sum over the frames
    std::uint8_t* low;          ///< smallest and largest grey level
    std::uint8_t* high;
};

/// A row of some pairs' frames, the coarsest first.
struct PairRows {
    int count = 0;
    std::array<const std::uint8_t*, kMaxBits> pattern{};
    std::array<const std::uint8_t*, kMaxBits> complement{};
};

/// What two neighbouring rows of stripe numbers say of the edges between them.
enum EdgeClass : std::uint8_t {
    kNoEdge,
    kRisingEdge,     ///< the next stripe below
    kFallingEdge,    ///< the stripe before below
    kAmbiguousEdge,  ///< the two pixels disagree in two or three pairs
    kNamelessEdge,   ///< they disagree in more, or in the wrong one
};
struct EdgeCounts {
    int found = 0;  ///< of any class
    int rising = 0;
    int falling = 0;
    int ambiguous = 0;
};

/// Where neighbouring edges of one pair show: from a pixel of the row above their gap on. Offsets
/// lead from there to the four rows around the gap.
struct EdgeRun {
    static constexpr int kMost = 8;
    const std::uint8_t* pattern;
    const std::uint8_t* complement;
    std::array<std::ptrdiff_t, 4> rows;
    const std::uint16_t* brightness;
    std::array<std::ptrdiff_t, 4> brightness_rows;
    int left;  ///< to the columns on either side
    int right;
};

/// Stripe edges whose places are to be found, side by side. Rows are counted from the one before
/// the edge's gap: the edge lies between the rows 1 and 2.
struct EdgeBatch {
    static constexpr int kSize = 128;
    template <typename T>
    using Column = std::array<T, kSize>;

    int count = 0;
    // Of the edge's pair: P − C and P + C, smoothed along the stripe (times four).
    std::array<Column<std::int32_t>, 4> difference;
    std::array<Column<std::int32_t>, 4> sum;
    // The sum of all frames, smoothed likewise, and at the columns to either side.
    std::array<Column<std::int32_t>, 4> brightness;
    Column<std::int32_t> brightness_left;
    Column<std::int32_t> brightness_right;
    Column<std::uint8_t> inside;  ///< 1 where the rows 0 and 3 are rows of the image
    Column<float> row;            ///< row 1

    // Results: see EdgeLight.
    Column<float> place;  ///< px
    Column<float> contrast;
    Column<float> gradient_x;
    Column<float> gradient_y;
    Column<float> drift_gain;
};

/// Cells of the vertex grid, side by side: see VertexGrid.
struct EdgeCells {
    std::uint8_t* measured;
    float* y;
    float* contrast;
    float* gradient_x;
    float* gradient_y;
    float* drift_gain;
};

/// Cells of one row that lie this many columns apart, with nothing between, can still be one
/// surface.
inline constexpr int kLargestGap = 3;

/// When neighbouring edges are one surface, px: along a stripe, by the change of place for each
/// column; across, by the width of the stripe between them in the direction `sign`.
struct ContinuityLimits {
    float max_step;
    float min_width;
    float max_width;
    float sign;
};

/// A row of the vertex grid and the next one, with flags where they are measured. All are readable
/// kLargestGap columns beyond the last.
struct LinkedRows {
    const float* y;
    const float* next_y;
    const std::uint8_t* measured;
    const std::uint8_t* next_measured;
};

/// Flags of the cells of a row that others continue.
struct RowLinks {
    std::array<std::uint8_t*, kLargestGap> along;  ///< … columns to the right
    std::uint8_t* across;                          ///< in the next row
};

/// A row of edges to be turned into points.
struct EdgeRow {
    const float* across;  ///< normalised place of each column
    const float* y;       ///< px
    float shift;          ///< px, added to each y
    float along_offset;   ///< normalised y = (y + shift − along_offset) · along_per_px
    float along_per_px;
};

/// A row of points: to be read, or to be written.
struct ConstPointRow {
    const float* x;
    const float* y;
    const float* z;
};
struct PointRow {
    float* x;
    float* y;
    float* z;

    // As a pointer becomes one to const.
    // NOLINTNEXTLINE(google-explicit-constructor)
    operator ConstPointRow() const { return {x, y, z}; }
};

/// The row of planes that begins at an index.
inline PointRow rowFrom(PointPlanes& planes, std::size_t i) {
    return {planes.x.data() + i, planes.y.data() + i, planes.z.data() + i};
}
inline ConstPointRow rowFrom(const PointPlanes& planes, std::size_t i) {
    return {planes.x.data() + i, planes.y.data() + i, planes.z.data() + i};
}

/// DeviceModel for one code: its plane is plane · P = plane_distance, and rays are affine in
/// (across, along).
struct DeviceRow {
    std::array<float, 3> ray_x;
    std::array<float, 3> ray_y;
    std::array<float, 3> radial;
    std::array<float, 2> tangential;
    std::array<float, 3> plane;
    float plane_distance;
};

/// The calibration's polynomials for one code: planes of coefficients by column, in the order in
/// which Horner's scheme takes them, for X, Y and Z.
struct PolynomialRow {
    int degree;
    float code;  ///< normalised
    const float* terms;
    std::ptrdiff_t term_stride;
    std::ptrdiff_t output_stride;
};

/// Rows of points around a row of cells: the finest pair's above and below, at the columns to the
/// left and right as far as `reach`, the cells' own, and those for a pixel more of their edges.
struct ReferenceRows {
    ConstPointRow above;
    ConstPointRow below;
    ConstPointRow here;
    ConstPointRow ahead;
    int reach;
    float least_mm_per_px;  ///< seen more edge on than this, a plane is of no use

    // Places of the edges in the finest pair's rows, px: the next ones above and below, and those
    // beyond, with flags where these are measured.
    const float* above_y;
    const float* below_y;
    const float* beyond_above_y;
    const float* beyond_below_y;
    const std::uint8_t* beyond_above;
    const std::uint8_t* beyond_below;
    float largest_jump;  ///< between the next rows, as a multiple of the distance to those beyond
    float largest_bend;  ///< of a row within its reach, px
};

/// The finest pair's surface at the cells of a row.
struct ReferencePlaneRow {
    PointRow normal;      ///< unit
    float* mm_per_px;     ///< along the normal, for a pixel of the edge's place
    std::uint8_t* known;  ///< in: whether the points around are; out: and the plane is of use
};
struct ConstReferencePlaneRow {
    ConstPointRow normal;
    const float* mm_per_px;
    const std::uint8_t* known;
};

/// A small rigid motion about a centre.
struct MotionAbout {
    std::array<float, 3> centre;
    std::array<float, 3> translation;
    std::array<float, 3> rotation;
};

/// A row of edges and the light around them: see VertexGrid.
struct EdgeLightRow {
    const std::uint8_t*
        measured;    ///< flags, from one column before the first to one after the last
    const float* y;  ///< likewise
    const float* gradient_x;
    const float* gradient_y;
    const float* drift_gain;
};

/// What displaces an edge where the reflectance changes: see correctEdgeBias().
struct BiasModel {
    float variance;      ///< of the camera's point spread, px²
    float drift_column;  ///< of the image within the edge's pair, px
    float drift_y;
};

/// The normal equations of six unknowns: the lower triangle of the products row by row, the
/// products with the value, and the sum of the residuals' moduli.
struct SixSums {
    std::array<float, 21> products;
    std::array<float, 6> right;
    float residuals;
};

/// Equations of an alignment, side by side. Their number is a multiple of kSumLanes; those that
/// only fill up are zero.
struct AlignmentBatch {
    std::array<const float*, 6> row;
    const float* distance;
    int count;
};

/// A sum over a row of values runs in so many lanes in every form, whatever the register's width.
inline constexpr int kSumLanes = 8;

/// Pixels of the reference image of a registration, side by side, in multiples of kSumLanes. Levers
/// are counted from the point about which the motion turns, px.
struct RegistrationPixels {
    int count;
    const float* level;
    const float* gradient_x;
    const float* gradient_y;
    const float* lever_x;
    const float* lever_y;
};

struct Similarity {
    float x, y;  ///< shift of the point about which it turns, and that point
    float turn;
    float scale;
    float middle_x, middle_y;
    float last_x, last_y;  ///< of the image: places up to here have a neighbour beyond
};

/// The same pixels in the other image.
struct WarpedPixels {
    std::int32_t* x;  ///< pixel at or before the place …
    std::int32_t* y;
    float* part_x;  ///< … and how far the place lies beyond it
    float* part_y;
    float* weight;                       ///< 1, or 0 where the place is outside
    std::array<std::int32_t*, 4> level;  ///< at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
};

struct RegistrationState {
    float unit;  ///< brings levels near 0 … 1
    float gain;  ///< current = gain · reference + offset
    float offset;
    float per_lever;       ///< brings the levers' coefficients to similar size
    float inverse_cutoff;  ///< of the robust weights; 0 weighs all alike
};

/// Two neighbouring rows of cells; quad i has the cells i and i + 1 of both.
struct QuadRows {
    ConstPointRow north;
    ConstPointRow south;
    const float* north_y;
    const float* south_y;
    const std::uint8_t* north_present;
    const std::uint8_t* south_present;
};

/// Flags of a row of quads; see quads.h.
struct QuadFlags {
    const std::uint8_t* first;
    const std::uint8_t* second;
    const std::uint8_t* falling;
};

/// How a row of quads is cut: flags, the square of each triangle's longest edge (0 where there is
/// none), and the edge itself in whole units, so that a sum does not depend on its order.
inline constexpr float kLengthUnits = 256;    // to the millimetre or pixel
inline constexpr float kLongestCounted = 64;  // mm
struct QuadCuts {
    std::uint8_t* first;
    std::uint8_t* second;
    std::uint8_t* falling;
    float* first_longest;
    float* second_longest;
    std::int32_t* first_length;
    std::int32_t* second_length;
};

/// The normals of a row of quads' triangles, as long as twice their areas.
struct TriangleRows {
    PointRow first;
    PointRow second;
};

/// The quads to the south and to the north of a row of vertices; vertex i lies between the quads
/// i − 1 and i.
struct VertexCorners {
    struct Side {
        ConstPointRow first;
        ConstPointRow second;
        const std::uint8_t* falling;
    };
    Side south;
    Side north;
};

/// Rows of edge positions around the one that is looked at.
struct RegularityRows {
    const float* before;
    const float* here;
    const float* after;
    const float* contrast;
};

/// How far from the middle between its neighbours an edge may lie: the larger of two limits, of
/// which the second, in grey levels of P − C, becomes one in px through the edge's contrast.
struct RegularityLimits {
    float tolerance_px;
    float noise_grey_levels;
};

/// A filter over 2 half_codes + 1 rows and 2 half_columns + 1 columns, alike in both directions:
/// the cell r rows and k columns from the middle has the weight along[k] + across[r].
struct FixedFilter {
    int half_codes;
    int half_columns;
    std::array<float, kWindows.back().half_columns + 1> along;
    std::array<float, kWindows.back().half_codes + 1> across;
};

/// A row of the vertex grid to be filtered.
struct FilteredRow {
    const float* y;                 ///< the row …
    int columns;                    ///< … and how far it is to the next
    const std::uint8_t* wanted;     ///< 1 where a result is asked for
    std::array<float*, 2> scratch;  ///< of a row
    float* filtered;                ///< results; other places stay as they are
};

/// Neighbouring cells of a row of the grid, through the window around each of which a quadratic is
/// to be fitted.
struct FitSpan {
    static constexpr int kSize = 8;
    static constexpr int kMostCells =
        (2 * kWindows.back().half_codes + 1) * (2 * kWindows.back().half_columns + 1);
    template <typename T>
    using Lane = std::array<T, kSize>;

    // Planes of the grid with a margin as wide as a window, at the first cell.
    const float* y = nullptr;
    const float* present = nullptr;  ///< 1 where there is a value, else 0
    std::ptrdiff_t stride = 0;       ///< from one code to the next

    int half_codes = 0;
    int half_columns = 0;
    float per_code = 1;  ///< scale of the places along the codes
    /// Places along the columns, by column from the middle on, scaled; and their squares.
    std::array<float, kWindows.back().half_columns + 1> places{};
    std::array<float, kWindows.back().half_columns + 1> squares{};
    float fewest = 0;           ///< cells that a fit needs
    Lane<float> cutoff;         ///< px
    Lane<std::uint8_t> wanted;  ///< 1 where a fit is asked for; elsewhere the result is void

    /// Takes the shape of a window.
    void setWindow(const Window& window) {
        half_codes = window.half_codes;
        half_columns = window.half_columns;
        per_code = 1.0f / float(window.half_codes);
        for (int k = 0; k <= half_columns; ++k) {
            places[k] = float(k) / float(half_columns);
            squares[k] = places[k] * places[k];
        }
    }

    Lane<float> correction;         ///< result: the surface at the cell, px from the cell
    Lane<std::uint8_t> consistent;  ///< result: the cell lies on the surface
};

/// The hot loops of reconstruction, in one form: chosen once, outside the loops. All forms give the
/// same bits.
struct Kernels {
    // NOLINTBEGIN(readability-identifier-naming): called as functions are.

    /// Prepares a row of pixels for its first pair.
    void (*startRow)(int width, const PixelRow& row);

    /// Adds pairs of frames to a row of pixels. A pair's sign at a pixel is that of P − C, averaged
    /// over the neighbours along the row with weights 1 2 1; it is the next bit of the Gray
    /// codeword, and the stripe number its binary form.
    void (*addPairs)(const PairRows& pairs, int width, const PixelRow& row);

    /// Leaves the modulation in `high`. @returns how many pixels of the row were saturated
    int (*finishRow)(int width, const PixelRow& row);

    /// Classifies the gaps between two rows of pixels. Pixels of less modulation than
    /// `min_modulation` show no edge.
    EdgeCounts (*classifyEdges)(const std::uint16_t* stripe_above,
                                const std::uint16_t* stripe_below,
                                const std::uint8_t* modulation_above,
                                const std::uint8_t* modulation_below, int min_modulation, int width,
                                std::uint8_t* edge_class);

    /// Gathers what the edges of a run show into EdgeRun::kMost edges of a batch from `first` on.
    void (*gatherEdges)(const EdgeRun& run, int first, EdgeBatch& batch);

    /// Locates the edges of a batch, and as many beyond as fill up the lanes: see decodeEdges().
    void (*locateEdges)(EdgeBatch& batch, float frames);

    /// Lays `count` edges of a batch, at most EdgeRun::kMost, into as many cells. Where one is
    /// measured already, the edge of the higher contrast stays. Beyond these, as many cells as make
    /// EdgeRun::kMost are read and written as they were.
    void (*layEdges)(const EdgeBatch& batch, int first, int count, const EdgeCells& cells);

    /// Finds which cells of a row its neighbours to the right and in the next row continue.
    void (*linkNeighbours)(const LinkedRows& rows, const ContinuityLimits& limits, int first,
                           int end, const RowLinks& links);

    /// Leaves in `kept` the measured cells of a row that two neighbours or more continue; those in
    /// the row before by the flags `from_before`. Links are read kLargestGap columns before the
    /// first. @returns how many are not kept
    int (*rejectUnsupported)(const RowLinks& links, const std::uint8_t* from_before,
                             const std::uint8_t* measured, int first, int end, std::uint8_t* kept);

    /// The points of `count` edges of a row, by the device or by polynomials.
    void (*deviceRow)(const DeviceRow& device, const EdgeRow& row, int count,
                      const PointRow& points);
    void (*polynomialRow)(const PolynomialRow& polynomial, const EdgeRow& row, int count,
                          const PointRow& points);

    /// Flags which of `count` depths lie between two, both included.
    void (*markInRange)(const float* z, float nearest, float farthest, int count,
                        std::uint8_t* inside);

    /// Completes the reference planes of `count` cells: see findReferencePlanes().
    void (*referencePlanes)(const ReferenceRows& rows, int count, const ReferencePlaneRow& planes);

    /// Moves `count` edges of a row by a rigid motion: see compensateMotion().
    void (*compensateRow)(const ConstPointRow& points, const ConstReferencePlaneRow& planes,
                          const MotionAbout& motion, int count, float* shift);

    /// The places of `count` edges without their bias: see correctEdgeBias().
    void (*correctBias)(const EdgeLightRow& row, const BiasModel& model, int count,
                        float* corrected);

    /// Sums the normal equations of an alignment: see estimateSurfaceMotion().
    void (*sumAlignment)(const AlignmentBatch& batch, const std::array<float, 6>& motion,
                         float inverse_cutoff, SixSums& sums);

    /// Where the pixels of a registration stand in the other image: see estimateImageMotion().
    void (*warpPixels)(const RegistrationPixels& pixels, const Similarity& motion,
                       const WarpedPixels& warped);

    /// Sums the normal equations of a registration.
    void (*sumRegistration)(const RegistrationPixels& pixels, const WarpedPixels& warped,
                            const RegistrationState& state, SixSums& sums);

    /// Halves and blurs an image: see estimateImageMotion().
    void (*halveRows)(const std::array<const std::uint8_t*, 4>& rows, int width,
                      std::uint16_t* halved);
    void (*blurRows)(const std::array<const std::uint16_t*, 3>& rows, int width,
                     std::uint16_t* blurred);

    /// Cuts `count` quads into triangles: see tessellate(). `sign` is 1 where y rises with the
    /// code, else −1.
    void (*cutQuads)(const QuadRows& rows, float sign, int count, const QuadCuts& cuts);

    /// The distances between the edges of a row and the next, in parts of a pixel (kLengthUnits to
    /// one), where both are there and less than `widest` px apart; else 0.
    void (*measureWidths)(const float* y, const float* next_y, const std::uint8_t* both,
                          float widest, int count, std::int32_t* widths);

    /// Leaves a flag only where the value is below the limit.
    void (*markShort)(const float* longest, float limit, int count, std::uint8_t* flags);

    /// The normals of `count` quads' triangles, zero where there is none.
    void (*triangleNormals)(const QuadRows& rows, const QuadFlags& flags, int count,
                            const TriangleRows& normals);

    /// The unit normals of `count` vertices: the sum of their triangles', times `side`; −Z where
    /// that is nothing.
    void (*vertexNormals)(const VertexCorners& corners, float side, int count,
                          const PointRow& normals);

    /// The quality of `count` measured vertices: 1 for an edge without noise, ½ where the noise is
    /// a fifth of a pixel.
    void (*vertexQuality)(const float* contrast, float noise_grey_levels, int count,
                          float* quality);

    /// Leaves a mark in `regular` only where the edge lies near the middle between its neighbours,
    /// in its row and in its column. All rows are read one column beyond first … end − 1.
    void (*markRegular)(const RegularityRows& rows, const RegularityLimits& limits, int first,
                        int end, std::uint8_t* regular);

    /// The index into kWindows that serves for the noise of each of `count` cells.
    void (*chooseWindows)(const float* contrast, float noise_grey_levels, int count,
                          std::uint8_t* window);

    /// Leaves in `common` the flags that all of `count` rows have.
    void (*keepCommon)(const std::uint8_t* const* rows, int count, int columns,
                       std::uint8_t* common);

    /// Leaves in `common`, from the column first to end − 1, a flag where all columns up to `reach`
    /// away have one.
    void (*keepSurrounded)(const std::uint8_t* flags, int reach, int first, int end,
                           std::uint8_t* common);

    /// Filters the columns first … end − 1 of a row.
    void (*filterRow)(const FilteredRow& row, const FixedFilter& filter, int first, int end);

    /// Fits the windows of a span: see robustFits().
    void (*fitWindows)(FitSpan& span);

    // NOLINTEND(readability-identifier-naming)
};

/// The form for this machine.
const Kernels& kernels();

/// All forms that this build holds, for tests and benchmarks: the plain one, a float and a pixel at
/// a time, is the reference for the others.
const Kernels& plainKernels();
const Kernels& portableKernels();
const Kernels* neonKernels();  ///< null where the build has none

}  // namespace facescan
