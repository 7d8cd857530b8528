#pragma once

#include <bit>
#include <cstdint>

namespace facescan {

/// The image axis along which the code changes: y for stripes along the image rows.
enum class CodeAxis { x, y };

/// The order of the frames of a scan.
enum class FrameOrder {
    interleaved,  ///< pattern 0, complement 0, pattern 1, complement 1, …
    grouped,      ///< all patterns, then all complements
};

inline constexpr int kMinBits = 4;
inline constexpr int kMaxBits = 12;

/// A binary reflected Gray code projected as stripes, each pattern followed by its complement.
/// Projecting and decoding both start from this definition (bundle format, "pattern").
///
/// The projector's axis is divided into 2^bits stripes; stripe c carries grayCodeword(c). Pair k
/// shows bit bits − 1 − k of it: the coarsest stripes first, the finest in pair bits − 1.
struct Pattern {
    int bits = 8;  ///< kMinBits … kMaxBits
    CodeAxis axis = CodeAxis::y;
    FrameOrder order = FrameOrder::interleaved;

    int stripes() const { return 1 << bits; }
    int frameCount() const { return 2 * bits; }
    int finestPair() const { return bits - 1; }

    /// The index of a pair's frame among the scan's pattern frames, 0 … frameCount() − 1.
    int frameIndex(int pair, bool complement) const {
        return order == FrameOrder::interleaved ? 2 * pair + int(complement)
                                                : pair + (complement ? bits : 0);
    }

    /// Whether stripe `c` is lit in the frame of `pair`.
    bool lit(int pair, bool complement, std::uint32_t c) const;

    friend bool operator==(const Pattern&, const Pattern&) = default;
};

/// The codeword of stripe `c` in the binary reflected Gray code.
constexpr std::uint32_t grayCodeword(std::uint32_t c) {
    return c ^ (c >> 1);
}

/// The stripe whose codeword is `g`: the inverse of grayCodeword.
constexpr std::uint32_t grayStripe(std::uint32_t g) {
    for (int shift = 1; shift < 32; shift *= 2) g ^= g >> shift;
    return g;
}

/// The pair whose frames show the edge between the stripes c − 1 and c (0 < c < 2^bits): their
/// codewords differ in the bit that is the lowest set bit of c.
constexpr int pairOfEdge(int c, int bits) {
    return bits - 1 - std::countr_zero(unsigned(c));
}

inline bool Pattern::lit(int pair, bool complement, std::uint32_t c) const {
    const bool bit = (grayCodeword(c) >> (bits - 1 - pair)) & 1u;
    return bit != complement;
}

}  // namespace facescan
