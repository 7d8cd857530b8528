#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace facescan {

/// The median (the upper one of two) of values that are not negative; 0 of none. Their bits, taken
/// for integers, have the same order, and are narrowed down by three histograms.
inline float medianOf(std::span<const float> values) {
    constexpr int kDigitBits[3] = {10, 11, 11};
    std::uint32_t prefix = 0;
    std::size_t rank = values.size() / 2;
    int shift = 32;
    for (const int bits : kDigitBits) {
        if (values.empty()) return 0;
        shift -= bits;
        const std::uint32_t digits = (1u << bits) - 1;
        std::array<std::uint32_t, 1 << 11> histogram{};
        for (const float value : values) {
            const std::uint32_t key = std::bit_cast<std::uint32_t>(value) >> shift;
            if (std::uint64_t(key) >> bits == prefix) ++histogram[key & digits];
        }
        std::uint32_t digit = 0;
        while (rank >= histogram[digit]) rank -= histogram[digit++];
        prefix = prefix << bits | digit;
    }
    return std::bit_cast<float>(prefix);
}

}  // namespace facescan
