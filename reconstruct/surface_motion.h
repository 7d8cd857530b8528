#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/calibrate.h"
#include "reconstruct/image_motion.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// A small rigid motion: a point p moves by translation + rotation × (p − centre).
struct RigidMotion {
    std::array<float, 3> translation{};  ///< mm
    std::array<float, 3> rotation{};     ///< rad, about the axes through the centre
};

/// The cell nearest to the middle of the measured surface.
struct SurfaceMiddle {
    int code = 0;  ///< 0 where nothing was measured
    int column = 0;
    ImagePoint place;  ///< in the stripe image
};
SurfaceMiddle findMiddle(const VertexGrid& grid, const PointPlanes& points);

/// How far the middle's point moves in space when its edge moves by a pixel, mm.
float millimetresPerPixel(const GridCalibration& calibration, const SurfaceMiddle& middle);

/// The motion of the face between each pair's moment and the reference moment (the finest pair's).
struct SurfaceMotion {
    Point centre;  ///< about which the motions turn, mm
    std::array<RigidMotion, kMaxBits> pairs{};
};

/// The finest pair's surface beside the cells of all other pairs: those of even codes.
struct ReferencePlanes {
    PointPlanes normal;               ///< unit
    std::vector<float> mm_per_px;     ///< along the normal, for a pixel of the edge's place
    std::vector<std::uint8_t> known;  ///< by cell: 1 where the plane is

    // Scratch: the first and the last of one row.
    PointPlanes ahead;
    std::vector<std::uint8_t> measured;
    std::vector<std::uint8_t> none;
};

/// Looks up the finest pair's surface in the rows above and below each even code, which are its
/// own. A plane is known where the points around are measured, they are one surface without a jump
/// or a crease, and it is not seen edge on.
void findReferencePlanes(const GridCalibration& calibration, const VertexGrid& grid,
                         const PointPlanes& points, ReferencePlanes& planes);

/// What is measured of the surface.
struct MeasuredSurface {
    const GridCalibration& calibration;
    const VertexGrid& grid;
    const PointPlanes& points;
    const ReferencePlanes& planes;
};

/// The equations of a pair's vertices for the six unknowns of a rigid motion: how far each lies
/// from the finest pair's surface, mm, and what the motion does to that.
struct AlignmentEquations {
    std::array<std::vector<float>, 6> row;
    std::vector<float> distance;
    int count = 0;  ///< the planes are filled up with zeros to whole groups of lanes
};

/// Estimates how each pair's vertices must move to lie on the surface of the finest pair's.
///
/// Every second code belongs to the finest pair, so that the vertices of all other pairs have its
/// vertices as neighbours on the grid, and the distance from its surface is known without search:
/// a rigid alignment, point to plane (Chen & Medioni 1991), with Tukey's weights. What the surface
/// leaves open, a plane's sliding along itself, is settled by the shift of the image.
///
/// @param middle         of the measured surface, about which the image motions turn and scale
/// @param image_motions  see estimateImageMotion
/// @param scratch        scratch memory
SurfaceMotion estimateSurfaceMotion(const MeasuredSurface& surface,
                                    const GridCalibration& calibration, int bits,
                                    const SurfaceMiddle& middle,
                                    const std::array<ImageMotion, kMaxBits>& image_motions,
                                    AlignmentEquations& scratch);

/// Moves every edge to where it would have been seen at the reference moment: the place where the
/// surface, moved rigidly, meets the edge's line in space again. Empties the cells of edges that
/// belong to the moving outline of a surface.
/// @returns the number of cells emptied
int compensateMotion(const MeasuredSurface& surface, const SurfaceMotion& motion, int bits,
                     VertexGrid& grid);

}  // namespace facescan
