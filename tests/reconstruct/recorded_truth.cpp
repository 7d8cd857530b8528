#include "reconstruct/recorded_truth.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace facescan::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const std::filesystem::path kData = TEST_DATA_DIR;

Vector3d placeOf(const Vertex& v) {
    return {v.x, v.y, v.z};
}

struct Facet {
    std::array<Vector3d, 3> corners;

    Vector3d normal() const {
        return (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    }

    double distance(const Vector3d& point) const {
        const Vector3d n = normal();
        const Vector3d foot = point - n.dot(point - corners[0]) * n;
        bool inside = true;
        double nearest = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 3; ++k) {
            const Vector3d a = corners[k];
            const Vector3d edge = corners[(k + 1) % 3] - a;
            inside = inside && n.dot(edge.cross(foot - a)) >= 0;
            const double along = std::clamp(edge.dot(point - a) / edge.squaredNorm(), 0.0, 1.0);
            nearest = std::min(nearest, (a + along * edge - point).norm());
        }
        return inside ? (point - foot).norm() : nearest;
    }
};

std::vector<Facet> readObj(const std::filesystem::path& path) {
    std::ifstream in(path);
    EXPECT_TRUE(in) << path;
    std::vector<Vector3d> vertices;
    std::vector<Facet> facets;
    char kind;
    while (in >> kind) {
        if (kind == 'v') {
            Vector3d& v = vertices.emplace_back();
            in >> v.x() >> v.y() >> v.z();
        } else {
            std::array<std::size_t, 3> index;
            in >> index[0] >> index[1] >> index[2];
            facets.push_back({{vertices.at(index[0] - 1), vertices.at(index[1] - 1),
                               vertices.at(index[2] - 1)}});
        }
    }
    return facets;
}

double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

double rmsOf(const std::vector<double>& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return values.empty() ? 0 : std::sqrt(squares / double(values.size()));
}

}  // namespace

ScanBundle recordedScan(const std::string& name) {
    return readBundle(kData / name);
}

Vector2d RecordedCamera::project(const Vector3d& point) const {
    const Vector2d p = point.head<2>() / point.z();
    const double r2 = p.squaredNorm();
    return focal_px * (1 + k1 * r2 + k2 * r2 * r2) * p + centre;
}

Vector3d RecordedCamera::ray(const Vector2d& pixel) const {
    const Vector2d seen = (pixel - centre) / focal_px;
    Vector2d p = seen;
    for (int step = 0; step < 20; ++step) {
        const double r2 = p.squaredNorm();
        p = seen / (1 + k1 * r2 + k2 * r2 * r2);
    }
    return {p.x(), p.y(), 1};
}

TrueSurface recordedPlane() {
    // 320 mm ahead, turned by 3° about the vertical and by 5° about the horizontal.
    const double radian = std::acos(-1.0) / 180;
    const Vector3d normal = Vector3d(-std::tan(3 * radian), std::tan(5 * radian), 1).normalized();
    return [normal](const Vector3d& point) -> std::optional<double> {
        return normal.dot(point - Vector3d(0, 0, 320));
    };
}

TrueSurface recordedSteps() {
    const std::vector<Facet> facets = readObj(kData / "truth" / "steps" / "surface.obj");
    return [facets](const Vector3d& point) -> std::optional<double> {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Facet& facet : facets) nearest = std::min(nearest, facet.distance(point));
        return nearest;
    };
}

FaceDepth::FaceDepth() {
    std::ifstream in(kData / "truth" / "face_still" / "depth.pgm", std::ios::binary);
    std::string magic;
    int levels = 0;
    in >> magic >> width_ >> height_ >> levels;
    in.get();
    EXPECT_EQ(magic, "P5");
    EXPECT_EQ(levels, 65535);
    depth_.resize(std::size_t(width_) * height_);
    for (double& depth : depth_) {
        const int high = in.get();
        const int level = 256 * high + in.get();
        depth = level > 0 ? 300 + level / 250.0 : 0;
    }
    EXPECT_TRUE(in) << "depth.pgm";
}

Vector3d FaceDepth::pointAt(int column, int row) const {
    const double depth = depth_[std::size_t(row) * width_ + column];
    return depth * camera_.ray(Vector2d(kSpacing * column, kSpacing * row));
}

std::optional<double> FaceDepth::distance(const Vector3d& point) const {
    const Vector2d place = camera_.project(point) / kSpacing;
    const int column = int(std::floor(place.x()));
    const int row = int(std::floor(place.y()));
    if (column < 0 || row < 0 || column + 1 >= width_ || row + 1 >= height_) return {};
    const std::array<Vector3d, 4> corners{pointAt(column, row), pointAt(column + 1, row),
                                          pointAt(column, row + 1), pointAt(column + 1, row + 1)};
    double nearest = corners[0].z();
    double farthest = nearest;
    for (const Vector3d& corner : corners) {
        nearest = std::min(nearest, corner.z());
        farthest = std::max(farthest, corner.z());
    }
    constexpr double kJump = 3;  // mm between pixels: the nose before the cheek
    if (nearest == 0 || farthest - nearest > kJump) return {};
    const double fx = place.x() - column;
    const double fy = place.y() - row;
    const Vector3d upper = corners[0] + fx * (corners[1] - corners[0]);
    const Vector3d lower = corners[2] + fx * (corners[3] - corners[2]);
    const Vector3d normal = (corners[3] - corners[0]).cross(corners[2] - corners[1]).normalized();
    return normal.dot(point - (upper + fy * (lower - upper)));
}

double FaceDepth::coverage(const Mesh& mesh, const Eigen::Isometry3d& to_world) const {
    std::vector<Vector2d> places;
    for (const Vertex& v : mesh.vertices) {
        places.push_back(camera_.project(to_world * placeOf(v)) / kSpacing);
    }
    std::vector<bool> covered(depth_.size());
    for (const Triangle& triangle : mesh.triangles) {
        const Vector2d& a = places[triangle[0]];
        const Vector2d ab = places[triangle[1]] - a;
        const Vector2d ac = places[triangle[2]] - a;
        const double area = ab.x() * ac.y() - ab.y() * ac.x();
        const auto range = [&](int axis, int size) {
            const auto [low, high] = std::minmax({0.0, ab[axis], ac[axis]});
            return std::pair{std::max(int(std::ceil(a[axis] + low)), 0),
                             std::min(int(std::floor(a[axis] + high)), size - 1)};
        };
        const auto [first_column, last_column] = range(0, width_);
        const auto [first_row, last_row] = range(1, height_);
        for (int row = first_row; row <= last_row; ++row) {
            for (int column = first_column; column <= last_column; ++column) {
                const Vector2d p = Vector2d(column, row) - a;
                const double u = (p.x() * ac.y() - p.y() * ac.x()) / area;
                const double v = (ab.x() * p.y() - ab.y() * p.x()) / area;
                if (u >= 0 && v >= 0 && u + v <= 1) {
                    covered[std::size_t(row) * width_ + column] = true;
                }
            }
        }
    }
    int known = 0;
    int hit = 0;
    for (std::size_t i = 0; i < depth_.size(); ++i) {
        known += depth_[i] > 0;
        hit += depth_[i] > 0 && covered[i];
    }
    return double(hit) / known;
}

Eigen::Isometry3d referencePose(const std::string& name) {
    const auto truth = nlohmann::json::parse(std::ifstream(kData / "truth" / name / "truth.json"));
    const auto pose = [&](int frame) {
        Eigen::Matrix<double, 3, 4> matrix;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 4; ++c) matrix(r, c) = truth["poses"][frame][r][c];
        }
        return matrix;
    };
    // Midway between the finest pattern and its complement, which come last.
    const int last = truth["first"].get<int>() + 2 * truth["bits"].get<int>() - 1;
    const int first = truth["order"] == "grouped" ? last - truth["bits"].get<int>() : last - 1;
    const Eigen::Matrix<double, 3, 4> mean = 0.5 * (pose(first) + pose(last));
    Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
    isometry.linear() = Eigen::Quaterniond(mean.leftCols<3>()).normalized().toRotationMatrix();
    isometry.translation() = mean.col(3);
    return isometry;
}

SurfaceError compare(const Mesh& mesh, const TrueSurface& surface,
                     const Eigen::Isometry3d& to_world) {
    std::vector<double> measured;
    std::vector<double> filled;
    for (const Vertex& v : mesh.vertices) {
        const std::optional<double> distance = surface(to_world * placeOf(v));
        if (!distance) continue;
        (v.quality > 0 ? measured : filled).push_back(std::fabs(*distance));
    }
    SurfaceError error;
    error.vertices = int(measured.size());
    if (measured.empty()) return error;
    error.rms = rmsOf(measured);
    error.filled_rms = rmsOf(filled);
    error.median = quantile(measured, 0.5);
    error.percentile_95 = quantile(measured, 0.95);
    const auto over =
        std::count_if(measured.begin(), measured.end(), [](double d) { return d > 1; });
    error.share_over_1mm = double(over) / double(measured.size());
    return error;
}

}  // namespace facescan::test
