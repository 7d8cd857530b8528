#pragma once

#include <Eigen/Core>

#include "sim/face_parameters.h"

namespace facescan::sim {

/// The shape of a head, neck and shoulders as a signed distance (mm) in the head's own frame: X to
/// the image's right, Y up, Z towards the viewer; the origin midway between the eyes' height and
/// the ears, the average's nose tip at Z = 107.
class FaceShape {
public:
    using Point = Eigen::Vector3f;

    explicit FaceShape(const FaceParameters& parameters);

    float distance(const Point& p) const;

    /// The point of the average face that lies at `p`: undoes width, length and asymmetry. All
    /// below take such a point.
    Point averaged(const Point& p) const;

    float skin(const Point& p) const;        ///< distance to the head without hair and eyeballs
    float hair(const Point& p) const;        ///< distance to the hair of the head
    float lips(const Point& p) const;        ///< distance to the bodies of the lips
    float eyelids(const Point& p) const;     ///< distance to the opening between the lids
    float beardCover(const Point& p) const;  ///< 0 bare … 1 beard
    Point eye(const Point& p) const;         ///< centre of the eyeball on the point's side
    float noseTipZ() const;

    static constexpr float kEyeRadius = 12.2f;

private:
    struct Landmarks {
        Point eye;  // on the side x ≥ 0
        Point nose_tip, nose_root, ala;
        float lip_half_width;
    };

    float skull(const Point& p) const;
    float neck(const Point& p) const;
    float withEar(float d, const Point& p) const;
    float withEyeSocket(float d, const Point& p) const;
    float withNose(float d, const Point& p) const;
    float withMouth(float d, const Point& p) const;
    float withChin(float d, const Point& p) const;
    float eyeball(const Point& p) const;
    Point lipSpace(const Point& p) const;

    FaceParameters parameters_;
    Landmarks at_;
};

}  // namespace facescan::sim
