#pragma once

#include <array>

#include "reconstruct/pattern.h"

namespace facescan {

/// The motion of the face during one pair of frames, against the reference moment (midway between
/// the finest pattern and its complement).
struct PairMotion {
    float dx_px = 0;     ///< along the image's x
    float dy_px = 0;     ///< along the image's y
    float shift_mm = 0;  ///< length of the translation of the face's middle
};

/// What a technician does next.
enum class Verdict {
    good,
    usable,  ///< a mesh, with the flaw that `reason` names
    repeat,  ///< do the scan again; `reason` names the cause
};

/// The cause behind a verdict, the most serious first.
enum class Reason {
    none,
    dark,          ///< no projector light reaches the scene: lens covered, projector off, too far
    over_exposed,  ///< most pixels are saturated
    no_pattern,    ///< there is light, but no stripes that decode to a surface
    too_little_surface,
    low_contrast,
    moved,
    noisy,
    gaps,  ///< parts of the lit scene are missing from the surface
};

/// Counts and quality of one reconstruction.
struct Report {
    // Decode.
    int edges_found = 0;    ///< zero crossings of sufficient contrast
    int edges_decoded = 0;  ///< … that the other pairs' signs name without contradiction
    // Filter.
    int vertices_rejected = 0;  ///< decoded, but out of range, isolated or off the surface
    // Result.
    int vertices_measured = 0;
    int vertices_filled = 0;
    int triangles = 0;
    int holes_found = 0;  ///< inside the surface
    int holes_filled = 0;

    double coverage = 0;         ///< share of the lit pixels in range that the mesh covers, 0 … 1
    double lit_share = 0;        ///< share of the image that the projector's light reaches, 0 … 1
    double saturated_share = 0;  ///< share of the image that is saturated in some frame, 0 … 1
    double modulation_median = 0;  ///< grey levels, over the lit pixels
    double noise_mm = 0;  ///< standard deviation of a vertex along the viewing ray, unsmoothed
    double motion_max_px = 0;
    double motion_max_mm = 0;
    std::array<PairMotion, kMaxBits> motion{};  ///< by pair; the first `bits` are used

    Verdict verdict = Verdict::repeat;
    Reason reason = Reason::no_pattern;
};

/// One sentence for the technician: what is wrong, and what to do.
const char* describe(Verdict verdict, Reason reason);

}  // namespace facescan
