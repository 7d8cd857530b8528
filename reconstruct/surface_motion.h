#pragma once

#include <array>
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
SurfaceMiddle findMiddle(const VertexGrid& grid, const std::vector<Point>& points);

/// How far the middle's point moves in space when its edge moves by a pixel, mm.
float millimetresPerPixel(const GridCalibration& calibration, const SurfaceMiddle& middle);

/// The motion of the face between each pair's moment and the reference moment (the finest pair's).
struct SurfaceMotion {
    Point centre;  ///< about which the motions turn, mm
    std::array<RigidMotion, kMaxBits> pairs{};
};

/// What is measured of the surface: the grid, its points, and how they move for a pixel of their
/// edges.
struct MeasuredSurface {
    const VertexGrid& grid;
    const std::vector<Point>& points;
    const std::vector<Point>& slopes;
};

/// A vertex' distance from the finest pair's surface, as an equation for the six unknowns of a
/// rigid motion.
struct AlignmentEquation {
    std::array<float, 6> row;
    float distance;  ///< mm
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
                                    std::vector<AlignmentEquation>& scratch);

/// Moves every edge to where it would have been seen at the reference moment: the place where the
/// surface, moved rigidly, meets the edge's line in space again.
void compensateMotion(const MeasuredSurface& surface, const SurfaceMotion& motion, int bits,
                      VertexGrid& grid);

}  // namespace facescan
