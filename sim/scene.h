#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reconstruct/mesh.h"
#include "sim/pose.h"

namespace facescan::sim {

/// How a point of a surface reflects: diffusely (Lambert), and around the mirror direction
/// (Blinn–Phong).
struct Material {
    float albedo = 0.5f;    ///< 0 … 1
    float specular = 0.0f;  ///< radiance at the peak of the highlight, in a white surface's
};

/// A triangle mesh with materials, in millimetres. The arrays positions, normals and materials
/// have one entry a vertex.
struct Surface {
    std::vector<Eigen::Vector3f> positions;
    std::vector<Eigen::Vector3f> normals;  ///< unit, for shading
    std::vector<Material> materials;
    std::vector<Triangle> triangles;
};

/// A sphere in closed form, for the truth of artefacts.
struct Sphere {
    Eigen::Vector3d centre;
    double radius = 0;
};

/// What stands before the scanner, in its frame at the first pattern frame.
struct Scene {
    std::string kind;  ///< "face", "mesh", "plane", "sphere" or "step"
    Surface surface{};
    std::optional<Sphere> sphere{};  ///< set where the surface is one
    double backdrop_z_mm = 0;  ///< a grey wall at this depth, not part of the surface; 0: none
    float backdrop_albedo = 0.45f;
};

/// Sets each vertex normal to the mean of its triangles' normals, weighted by area. They point to
/// the side from which the triangles run counter-clockwise.
void computeNormals(Surface& surface);

/// Moves every vertex, normal and closed form. The backdrop stays.
Scene transformed(Scene scene, const Pose& pose);

/// A quarter turn about the camera's axis that takes the image's downward direction to its left.
Pose quarterTurn();

/// The scene as a device turned sideways() must find it to see it whole.
Scene turnedSideways(Scene scene);

}  // namespace facescan::sim
