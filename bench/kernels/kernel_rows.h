#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "reconstruct/kernels/kernels.h"

namespace facescan::bench {

/// Rows for a kernel to work on. They are kept as long as this is, and can be read and written
/// kMargin values beyond either end.
class KernelRows {
public:
    static constexpr int kMargin = 16;

    explicit KernelRows(int length) : length_(length) {}
    std::ptrdiff_t stride() const { return length_ + 2 * kMargin; }  ///< from one to the next

    /// Several rows one after the other; values are drawn evenly from low … high.
    float* floats(float low, float high, int rows = 1) {
        std::uniform_real_distribution<float> value(low, high);
        return fill<float>(rows, [&] { return value(random_); });
    }
    template <typename T>
    T* integers(int low, int high, int rows = 1) {
        std::uniform_int_distribution<int> value(low, high);
        return fill<T>(rows, [&] { return T(value(random_)); });
    }
    /// Nine of ten are set.
    std::uint8_t* flags() {
        std::bernoulli_distribution value(0.9);
        return fill<std::uint8_t>(1, [&] { return std::uint8_t(value(random_)); });
    }
    /// Zeros, for results.
    template <typename T>
    T* room() {
        return fill<T>(1, [] { return T(0); });
    }
    PointRow points(float low, float high) {
        return {floats(low, high), floats(low, high), floats(low, high)};
    }

    /// Keeps what is no row. Its bytes are to be told to count().
    template <typename T>
    T* keep(T value) {
        const auto kept = std::make_shared<T>(std::move(value));
        kept_.push_back(kept);
        return kept.get();
    }
    void count(double bytes) { bytes_ += bytes; }

    /// Of all rows, each counted once.
    double bytes() const { return bytes_; }

private:
    template <typename T, typename Draw>
    T* fill(int rows, Draw draw) {
        std::vector<T> values(std::size_t(rows * stride()));
        for (T& value : values) value = draw();
        count(double(rows) * length_ * sizeof(T));
        return keep(std::move(values))->data() + kMargin;
    }

    int length_;
    std::mt19937 random_{7};
    std::vector<std::shared_ptr<void>> kept_;
    double bytes_ = 0;
};

}  // namespace facescan::bench
