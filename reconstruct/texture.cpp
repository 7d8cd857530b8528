#include "reconstruct/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace facescan {
namespace {

constexpr int kRadius = 2;  // of the mean filter
constexpr int kDiameter = 2 * kRadius + 1;
constexpr int kLevels = 1 << 12;  // the texture before the stretch

/// Level of the sum of two 8-bit pixels, gamma corrected.
using GammaTable = std::array<std::uint16_t, 511>;

GammaTable gammaTable(double gamma) {
    GammaTable table;
    for (int sum = 0; sum < int(table.size()); ++sum) {
        table[sum] = std::uint16_t(unitPower(sum / 510.0, gamma) * (kLevels - 1) + 0.5);
    }
    return table;
}

/// Clamps a row or column that the filter reaches beyond the border.
int clamped(int i, int size) {
    return std::clamp(i, 0, size - 1);
}

/// Sums of kDiameter neighbours along the row.
void sumAlongRow(const std::uint16_t* row, int width, std::uint16_t* sums) {
    unsigned sum = 0;
    for (int x = -kRadius; x <= kRadius; ++x) sum += row[clamped(x, width)];
    for (int x = 0; x < width; ++x) {
        sums[x] = std::uint16_t(sum);
        sum += row[clamped(x + kRadius + 1, width)];
        sum -= row[clamped(x - kRadius, width)];
    }
}

/// The level below which `share` of all pixels lie.
int quantile(const std::vector<std::uint32_t>& histogram, std::size_t pixels, double share) {
    const auto wanted = std::size_t(double(pixels) * share);
    std::size_t below = 0;
    for (std::size_t level = 0; level < histogram.size(); ++level) {
        below += histogram[level];
        if (below > wanted) return int(level);
    }
    return int(histogram.size()) - 1;
}

void stretch(const std::vector<std::uint16_t>& levels, std::vector<std::uint32_t>& histogram,
             GreyImage& texture) {
    histogram.assign(kLevels, 0);
    for (const std::uint16_t level : levels) ++histogram[level];
    const int low = quantile(histogram, levels.size(), 0.005);
    const int high = std::max(quantile(histogram, levels.size(), 0.995), low + 1);
    std::array<std::uint8_t, kLevels> table;
    for (int level = 0; level < kLevels; ++level) {
        const int grey = ((level - low) * 255 * 2 + (high - low)) / ((high - low) * 2);
        table[level] = level <= low ? std::uint8_t(0) : std::uint8_t(std::min(grey, 255));
    }
    for (std::size_t i = 0; i < levels.size(); ++i) texture.pixels[i] = table[levels[i]];
}

}  // namespace

double unitPower(double x, double exponent) {
    if (x <= 0) return exponent == 0 ? 1.0 : 0.0;
    // log2(x) by halving the interval of its mantissa: each squaring yields one binary digit.
    double logarithm = 0;
    while (x < 1) {
        x *= 2;
        logarithm -= 1;
    }
    for (double digit = 0.5; digit > 1e-9; digit *= 0.5) {
        x *= x;
        if (x >= 2) {
            x *= 0.5;
            logarithm += digit;
        }
    }
    // 2^(−p) as a product of roots of one half.
    double power = -logarithm * exponent;
    double result = 1;
    while (power >= 1) {
        result *= 0.5;
        power -= 1;
    }
    double root = 0.5;
    for (double digit = 0.5; digit > 1e-9; digit *= 0.5) {
        root = std::sqrt(root);
        if (power >= digit) {
            result *= root;
            power -= digit;
        }
    }
    return result;
}

void makeTexture(const FrameStackView& frames, const ScanDescription& scan, double gamma,
                 TextureScratch& scratch, GreyImage& texture) {
    const int width = scan.image.width;
    const int height = scan.image.height;
    const std::size_t pixels = std::size_t(width) * height;
    texture.width = width;
    texture.height = height;
    texture.pixels.resize(pixels);

    const Pattern& pattern = scan.pattern;
    const auto finest = [&](bool complement, int y) {
        const int index = scan.first_frame + pattern.frameIndex(pattern.finestPair(), complement);
        return frames.frame(index) + std::size_t(scan.image.y + y) * frames.row_stride +
               scan.image.x;
    };
    const GammaTable table = gammaTable(gamma);
    scratch.corrected.resize(width);
    scratch.row_sums.resize(pixels);
    scratch.filtered.resize(pixels);
    std::uint16_t* corrected = scratch.corrected.data();
    for (int y = 0; y < height; ++y) {
        const std::uint8_t* p = finest(false, y);
        const std::uint8_t* c = finest(true, y);
        for (int x = 0; x < width; ++x) corrected[x] = table[p[x] + c[x]];
        sumAlongRow(corrected, width, scratch.row_sums.data() + std::size_t(y) * width);
    }

    scratch.column_sums.assign(width, 0);
    std::uint32_t* column_sums = scratch.column_sums.data();
    const auto row = [&](int y) {
        return scratch.row_sums.data() + std::size_t(clamped(y, height)) * width;
    };
    for (int y = -kRadius; y <= kRadius; ++y) {
        for (int x = 0; x < width; ++x) column_sums[x] += row(y)[x];
    }
    for (int y = 0; y < height; ++y) {
        std::uint16_t* out = scratch.filtered.data() + std::size_t(y) * width;
        const std::uint16_t* enters = row(y + kRadius + 1);
        const std::uint16_t* leaves = row(y - kRadius);
        for (int x = 0; x < width; ++x) {
            out[x] = std::uint16_t(column_sums[x] / (kDiameter * kDiameter));
            column_sums[x] += enters[x];
            column_sums[x] -= leaves[x];
        }
    }
    stretch(scratch.filtered, scratch.histogram, texture);
}

}  // namespace facescan
