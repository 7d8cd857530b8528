#pragma once

namespace facescan {

/// The thresholds of the stages. The defaults serve a face at 300–520 mm; docs/reconstruction.md
/// gives the reason and the measurement behind each.
struct Options {
    /// decode: pixels whose grey level varies by less than this over the pattern frames are not
    /// reached by the projector's light. Grey levels, 1 … 255.
    int min_modulation = 6;

    /// lens blur: standard deviation of the camera's point spread, lens and pixel together. Where
    /// the reflectance changes, the blur moves a stripe edge towards the brighter side by a
    /// distance proportional to its square. Pixels, 0 … 2; 0 leaves the edges where they were seen.
    double lens_blur_px = 0.5;

    /// motion: whether the vertices are moved to the reference moment.
    bool compensate_motion = true;

    /// filter: neighbouring vertices of one stripe edge farther apart than this along the code's
    /// axis, for each column between them, are not one surface. Pixels.
    double max_step_px = 2.0;
    /// filter: where a surface ends, foreground and background mix in so many columns: their own
    /// places do not count, and they take those of the surface beside them. 0 … 8.
    int end_columns = 2;
    /// filter: connected pieces of fewer vertices than this are no part of a face.
    int min_component = 200;

    /// smooth: whether edge positions are smoothed on the vertex grid.
    bool smooth = true;
    /// smooth: the largest residual of a vertex, in standard deviations of its noise, that is
    /// noise and not a false measurement.
    double outlier_sigmas = 4.7;
    /// smooth: the noise is never taken for less than this: a vertex nearer than outlier_sigmas
    /// times this to its neighbours' surface is kept. Pixels.
    double noise_floor_px = 0.05;
    /// smooth: a vertex farther than this from its neighbours' surface is a false measurement
    /// however noisy it is. Pixels.
    double max_residual_px = 0.4;

    /// calibrate: whether the camera and the projector behind the calibration's polynomials are
    /// recovered, and used in their place where they explain them.
    bool recover_device = true;

    /// fill: whether holes inside the surface are closed.
    bool fill_holes = true;
    /// fill: the largest hole that is closed, across the diagonal of its bounding box. Millimetres.
    double max_hole_mm = 10.0;
    /// fill: a hole from whose rim the surface fitted to it is farther than this (root mean square)
    /// has a real gap behind it. Pixels.
    double max_rim_residual_px = 2.5;

    /// tessellate: a face whose longest edge is this many times the mean of the longest edges, or
    /// more, spans a gap (thesis, section 3.8).
    double max_edge_ratio = 7.0;

    /// texture: exponent of the gamma correction.
    double gamma = 1.0 / 2.2;
};

}  // namespace facescan
