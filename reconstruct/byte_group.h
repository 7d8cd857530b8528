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

        /// How many of the first bytes do not have it.
        int lead() const { return marks_ == 0 ? kSize : std::countr_zero(marks_) / 8; }
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

/// Calls visit(x) where bytes[x] is `value`, from `first` to end − 1. A group of bytes is readable
/// beyond the end.
template <typename Visit>
void forEachMatch(const std::uint8_t* bytes, int first, int end, std::uint8_t value, Visit visit) {
    for (int x = first; x < end; ++x) {
        x += ByteGroup(bytes + x).matches(value).lead();
        if (x < end && bytes[x] == value) visit(x);
    }
}

}  // namespace facescan
