#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/bundle.h"
#include "reconstruct/mesh.h"

namespace facescan::test {

/// A recorded scan of tests/data.
ScanBundle recordedScan(const std::string& name);

/// The ray caster's camera: a pinhole with radial distortion.
struct RecordedCamera {
    double focal_px = 1140;
    Eigen::Vector2d centre{242.3, 380.6};
    double k1 = -0.08;
    double k2 = 0.03;

    Eigen::Vector2d project(const Eigen::Vector3d& point) const;
    /// Direction of a pixel's ray, its Z component 1.
    Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

/// A true surface: the distance of a point from it, mm along its normal, positive behind it;
/// nothing where it is not known.
using TrueSurface = std::function<std::optional<double>(const Eigen::Vector3d& point)>;

/// The tilted plane of `plane_near`.
TrueSurface recordedPlane();
/// The stairs and roofs of `steps`.
TrueSurface recordedSteps();

/// The depth of the face, by pixel of the ray caster's camera where that saw it fully lit, at less
/// than 70° from camera and projector.
class FaceDepth {
public:
    FaceDepth();
    std::optional<double> distance(const Eigen::Vector3d& point) const;
    /// The share of the depth's pixels that a mesh covers in the camera's view.
    double coverage(const Mesh& mesh, const Eigen::Isometry3d& to_world) const;

private:
    Eigen::Vector3d pointAt(int column, int row) const;

    static constexpr int kSpacing = 2;  ///< px of the camera for each pixel of the map
    RecordedCamera camera_;
    int width_ = 0;
    int height_ = 0;
    std::vector<double> depth_;  ///< mm; 0 where not known
};

/// From the scanner's frame at the reference moment to the world, in which the face stands.
Eigen::Isometry3d referencePose(const std::string& name);

struct SurfaceError {
    int vertices = 0;   ///< measured ones whose distance is known
    double rms = 0;     ///< mm
    double median = 0;  ///< of the distance's modulus
    double percentile_95 = 0;
    double share_over_1mm = 0;
    double filled_rms = 0;
};

SurfaceError compare(const Mesh& mesh, const TrueSurface& surface,
                     const Eigen::Isometry3d& to_world = Eigen::Isometry3d::Identity());

}  // namespace facescan::test
