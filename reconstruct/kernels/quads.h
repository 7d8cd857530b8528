#pragma once

#include <cstdint>

#include "reconstruct/kernels/form.h"
#include "reconstruct/kernels/kernels.h"
#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/motion.h"

namespace facescan {

template <typename Lanes>
FACESCAN_KERNEL void cutQuads(const QuadRows& rows, float sign, int count, const QuadCuts& cuts) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        using Vector = Vector3<L>;
        using Mask = typename L::Mask;
        const auto square = [](const Vector& a, const Vector& b) FACESCAN_INLINE_LAMBDA {
            const Vector d = a - b;
            return dot(d, d);
        };
        const auto pick = [](Mask m, Mask a, Mask b)
                              FACESCAN_INLINE_LAMBDA { return (m & a) | (b & !m); };
        const Vector nw = Vector::load(rows.north, i);
        const Vector ne = Vector::load(rows.north, i + 1);
        const Vector sw = Vector::load(rows.south, i);
        const Vector se = Vector::load(rows.south, i + 1);
        const L falling_cut = square(nw, se);
        const L rising_cut = square(ne, sw);
        const L west_side = square(nw, sw);
        const L east_side = square(ne, se);

        const Mask has_nw = Mask::load(rows.north_present + i);
        const Mask has_ne = Mask::load(rows.north_present + i + 1);
        const Mask has_sw = Mask::load(rows.south_present + i);
        const Mask has_se = Mask::load(rows.south_present + i + 1);
        // Three cells are cut so that they form one of the two triangles.
        const Mask falling = has_nw & has_se & ((falling_cut <= rising_cut) | !has_ne | !has_sw);

        // Twice the area in the image, for triangles with a west and with an east side: positive
        // where the camera sees the front.
        constexpr float kSmallest = 1e-3f;
        const L down_west = L(sign) * (L::load(rows.south_y + i) - L::load(rows.north_y + i));
        const L down_east =
            L(sign) * (L::load(rows.south_y + i + 1) - L::load(rows.north_y + i + 1));
        const Mask west = L(kSmallest) < down_west;
        const Mask east = L(kSmallest) < down_east;
        const Mask first = has_nw & has_ne & pick(falling, has_se & east, has_sw & west);
        const Mask second = has_se & has_sw & pick(falling, has_nw & west, has_ne & east);
        first.store(cuts.first + i);
        second.store(cuts.second + i);
        falling.store(cuts.falling + i);

        const L cut = select(falling, falling_cut, rising_cut);
        const L first_longest =
            largerOf(largerOf(square(nw, ne), cut), select(falling, east_side, west_side));
        const L second_longest =
            largerOf(largerOf(square(sw, se), cut), select(falling, west_side, east_side));
        select(first, first_longest, L(0.0f)).store(cuts.first_longest + i);
        select(second, second_longest, L(0.0f)).store(cuts.second_longest + i);
        const auto length = [](L squared) FACESCAN_INLINE_LAMBDA {
            constexpr float kTiny = 1e-12f;
            const L root = squared * inverseRoot(largerOf(squared, L(kTiny)));
            return smallerOf(root, L(kLongestCounted)) * L(kLengthUnits);
        };
        length(select(first, first_longest, L(0.0f))).store(cuts.first_length + i);
        length(select(second, second_longest, L(0.0f))).store(cuts.second_length + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void markShort(const float* longest, float limit, int count, std::uint8_t* flags) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        (L::Mask::load(flags + i) & (L::load(longest + i) < L(limit))).store(flags + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void triangleNormals(const QuadRows& rows, const QuadFlags& flags, int count,
                                     const TriangleRows& normals) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        using Vector = Vector3<L>;
        const auto pick = [](typename L::Mask m, const Vector& a,
                             const Vector& b) FACESCAN_INLINE_LAMBDA {
            return Vector{select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
        };
        const Vector nw = Vector::load(rows.north, i);
        const Vector ne = Vector::load(rows.north, i + 1);
        const Vector sw = Vector::load(rows.south, i);
        const Vector se = Vector::load(rows.south, i + 1);
        const auto falling = L::Mask::load(flags.falling + i);
        const auto first = L::Mask::load(flags.first + i);
        const auto second = L::Mask::load(flags.second + i);
        const Vector none{L(0.0f), L(0.0f), L(0.0f)};
        // A cross product's length is twice the area.
        const Vector a = cross(ne - nw, pick(falling, se, sw) - nw);
        const Vector corner = pick(falling, nw, ne);
        const Vector b = cross(se - corner, sw - corner);
        pick(first, a, none).store(normals.first, i);
        pick(second, b, none).store(normals.second, i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void vertexNormals(const VertexCorners& corners, float side, int count,
                                   const PointRow& normals) {
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        using Vector = Vector3<L>;
        const auto part = [&](const ConstPointRow& row, std::uint8_t wanted,
                              const std::uint8_t* falling, int at) FACESCAN_INLINE_LAMBDA {
            const auto f = L::Mask::load(falling + at);
            const auto counts = wanted ? f : !f;
            const Vector v = Vector::load(row, at);
            const L none(0.0f);
            return Vector{select(counts, v.x, none), select(counts, v.y, none),
                          select(counts, v.z, none)};
        };
        const auto& [south, north] = corners;
        // Of the quad of which the vertex is the north-west corner, the first triangle always has
        // it, the second where the cut falls; and so on around.
        const Vector south_east =
            Vector::load(south.first, i) + part(south.second, 1, south.falling, i);
        const Vector south_west =
            Vector::load(south.first, i - 1) + part(south.second, 0, south.falling, i - 1);
        const Vector north_west =
            Vector::load(north.second, i - 1) + part(north.first, 1, north.falling, i - 1);
        const Vector north_east =
            Vector::load(north.second, i) + part(north.first, 0, north.falling, i);
        const Vector sum = ((south_east + south_west) + (north_west + north_east)) * L(side);
        const L square = dot(sum, sum);
        constexpr float kSmallest = 1e-30f;
        const auto exists = L(kSmallest) < square;
        const L scale = inverseRoot(select(exists, square, L(1.0f)));
        const Vector unit = sum * scale;
        Vector{select(exists, unit.x, L(0.0f)), select(exists, unit.y, L(0.0f)),
               select(exists, unit.z, L(-1.0f))}
            .store(normals, i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void vertexQuality(const float* contrast, float noise_grey_levels, int count,
                                   float* quality) {
    constexpr float kHalf = 0.2f;  // px of noise
    constexpr float kSmallest = 1e-3f;
    const float noise = noise_grey_levels / kHalf;
    const float noise_square = noise * noise;
    forLanes<Lanes>(0, count, [&]<typename L>(int i) FACESCAN_INLINE_LAMBDA {
        const L c = L::load(contrast + i);
        const L square = c * c;
        const L sum = square + L(noise_square);
        constexpr float kTiny = 1e-30f;
        const L share = square * reciprocal(largerOf(sum, L(kTiny)));
        largerOf(share, L(kSmallest)).store(quality + i);
    });
}

template <typename Lanes>
FACESCAN_KERNEL void measureWidths(const float* y, const float* next_y, const std::uint8_t* both,
                                   float widest, int count, std::int32_t* widths) {
    forLanes<Lanes>(0, count, [&]<typename L>(int x) FACESCAN_INLINE_LAMBDA {
        const L width = abs(L::load(next_y + x) - L::load(y + x));
        const auto counts = L::Mask::load(both + x) & (width < L(widest));
        (select(counts, width, L(0.0f)) * L(kLengthUnits)).store(widths + x);
    });
}

}  // namespace facescan
