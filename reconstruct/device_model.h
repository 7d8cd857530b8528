#pragma once

#include <array>
#include <optional>

#include "reconstruct/point.h"
#include "reconstruct/scan.h"

namespace facescan {

/// A camera and a projector: what the polynomials of a calibration stand for.
///
/// The camera sees along (X/Z, Y/Z): an affine map of the normalised pixel coordinates, then a
/// radial and tangential distortion (Brown 1966), taken from the distorted to the true ray so that
/// no inversion is needed. The projector's stripe edge of code w is the plane
/// (edge + w · edge_per_code) · P = 1 + w · offset_per_code: a pencil of planes through the line of
/// a pinhole projector's centre.
struct DeviceModel {
    std::array<double, 3> ray_x{};  ///< X/Z before distortion = ray_x · (u, v, 1)
    std::array<double, 3> ray_y{};
    std::array<double, 3> radial{};
    std::array<double, 2> tangential{};
    std::array<double, 3> edge{};
    std::array<double, 3> edge_per_code{};
    double offset_per_code = 0;

    /// @param u, v, w  the calibration's normalised x, y and code
    template <typename Scalar>
    std::array<Scalar, 3> at(Scalar u, Scalar v, Scalar w) const;
};

/// Recovers the camera and the projector behind a calibration. A polynomial of degree 5 leaves
/// 0.02 mm on a face even where the device is ideal; the device itself does not.
///
/// The model is fitted so that what a polynomial can say of it equals the calibration: both are
/// compared after projection onto the polynomials of the calibration's degree, over its image and
/// range. It is accepted only where it explains the calibration: where what is left unexplained is
/// smaller than what the polynomial must leave out of the model. Else the device is of another kind
/// (a projector with a distorting lens, a bent board), and the polynomials are the better truth.
std::optional<DeviceModel> recoverDevice(const ScanDescription& scan);

template <typename Scalar>
std::array<Scalar, 3> DeviceModel::at(Scalar u, Scalar v, Scalar w) const {
    const auto number = [](double value) { return Scalar(value); };
    const Scalar x = number(ray_x[0]) * u + number(ray_x[1]) * v + number(ray_x[2]);
    const Scalar y = number(ray_y[0]) * u + number(ray_y[1]) * v + number(ray_y[2]);
    const Scalar r2 = x * x + y * y;
    const Scalar stretch =
        1 + r2 * (number(radial[0]) + r2 * (number(radial[1]) + r2 * number(radial[2])));
    const Scalar p1 = number(tangential[0]);
    const Scalar p2 = number(tangential[1]);
    const Scalar ray_to_x = x * stretch + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    const Scalar ray_to_y = y * stretch + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    const Scalar across = (number(edge[0]) + w * number(edge_per_code[0])) * ray_to_x +
                          (number(edge[1]) + w * number(edge_per_code[1])) * ray_to_y +
                          (number(edge[2]) + w * number(edge_per_code[2]));
    const Scalar z = (1 + w * number(offset_per_code)) / across;
    return {ray_to_x * z, ray_to_y * z, z};
}

}  // namespace facescan
