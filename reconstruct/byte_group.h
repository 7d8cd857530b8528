#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace facescan {

/// Eight bytes side by side, each below 128, that are looked at together.
class ByteGroup {
public:
    static constexpr int kSize = 8;

    explicit ByteGroup(const void* first) { std::memcpy(&bytes_, first, kSize); }

    bool allZero() const { return bytes_ == 0; }

    /// Which of the bytes have a value.
    class Matches {
    public:
        explicit Matches(std::uint64_t marks) : marks_(marks) {}

        bool none() const { return marks_ == 0; }
        /// How many of the first bytes do not have it.
        int lead() const { return none() ? kSize : std::countr_zero(marks_) / 8; }
        /// How many of the first bytes have it.
        int run() const { return std::countr_one(marks_ | kOnes * 0x7F) / 8; }

    private:
        std::uint64_t marks_;  ///< the highest bit of each byte
    };
    Matches matches(std::uint8_t value) const {
        // No carry leaves a byte.
        return Matches(~((bytes_ ^ kOnes * value) + kOnes * 0x7F) & kOnes * 0x80);
    }

private:
    static constexpr std::uint64_t kOnes = 0x0101010101010101;
    std::uint64_t bytes_;
};

}  // namespace facescan
