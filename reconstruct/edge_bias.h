#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/image_motion.h"
#include "reconstruct/pattern.h"
#include "reconstruct/vertex_grid.h"

namespace facescan {

/// How far the image moves within each pair, from the pattern's frame to the complement's, px.
using PairDrift = std::array<ImagePoint, kMaxBits>;

/// The drift within each pair, from the motion of the pairs against each other.
PairDrift driftWithinPairs(const Pattern& pattern,
                           const std::array<ImageMotion, kMaxBits>& image_motions);

/// Moves each stripe edge back from where the reflectance of the scene has displaced it.
///
/// Lens blur: the camera averages reflectance × stripe over its point spread of variance σ². For a
/// Gaussian point spread, and an edge that is odd around its place, pattern and complement then
/// cross where code + σ² ∇ln(a) · ∇code reaches the edge's value (Stein's lemma), a being the
/// reflectance as lit: off by −σ² (∂ln a/∂y − ∂ln a/∂x · dy/dx) along the code's axis, whatever the
/// blur of the projector.
///
/// Drift: where the scene moves by d from the pattern's frame to the complement's, their
/// reflectance at a pixel differs by −d · ∇ln(a), and they cross off by −d · ∇ln(a) · (P + C) / (2
/// |∂(P − C)/∂y|).
///
/// @param lens_blur_px  σ
/// @param measured      scratch memory
void correctEdgeBias(double lens_blur_px, const PairDrift& drift, int bits,
                     std::vector<std::uint8_t>& measured, VertexGrid& grid);

}  // namespace facescan
