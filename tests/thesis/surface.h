#pragma once

#include <vector>

#include "reconstruct/mesh.h"

namespace facescan::thesis {

/// A place in an image, in pixels: whole numbers are the centres of pixels.
struct PlanePoint {
    double x = 0;
    double y = 0;
};

/// A place in the scanner's frame, in millimetres.
struct SpacePoint {
    double x = 0;
    double y = 0;
    double z = 0;
};

double distance(const SpacePoint& a, const SpacePoint& b);

struct SurfaceVertex {
    PlanePoint image;  ///< in the full frame
    SpacePoint place;
    int line = 0;  ///< the image line across the stripes on which it was found; −1: filled in
};

/// A mesh on its way through the stages. Faces run counter-clockwise as one looks at the image.
struct Surface {
    std::vector<SurfaceVertex> vertices;
    std::vector<Triangle> faces;
};

/// Twice the area of a triangle in the image; above 0 where it runs counter-clockwise as one looks
/// at the image, whose y points down.
double doubleArea(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Removes the vertices that are not marked to be kept, and the faces that use one of them.
void keepVertices(const std::vector<bool>& keep, Surface& surface);

/// Removes the vertices that no face uses.
void dropUnusedVertices(Surface& surface);

}  // namespace facescan::thesis
