#include "reconstruct/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reconstruct/kernels/form.h"

namespace facescan {
namespace {

constexpr int kRadius = 2;  // of the mean filter
constexpr int kDiameter = 2 * kRadius + 1;
/// Levels before the stretch: as many as let the filter's sum fit 16 bits.
constexpr int kLevels = 0xFFFF / (kDiameter * kDiameter);
/// The histogram's bins hold so many sums each.
constexpr int kBinShift = 4;

/// Level of the sum of two 8-bit pixels, gamma corrected.
using GammaTable = std::array<std::uint16_t, 511>;

GammaTable gammaTable(double gamma) {
    GammaTable table;
    for (int sum = 0; sum < int(table.size()); ++sum) {
        table[sum] = std::uint16_t(unitPower(sum / 510.0, gamma) * (kLevels - 1) + 0.5);
    }
    return table;
}

/// Corrects a row of the pair's sum, and repeats its ends for the filter.
FACESCAN_KERNEL void correctRow(const std::uint8_t* p, const std::uint8_t* c, int width,
                                const GammaTable& table, std::uint16_t* padded) {
    std::uint16_t* corrected = padded + kRadius;
    for (int x = 0; x < width; ++x) corrected[x] = table[p[x] + c[x]];
    for (int n = 0; n < kRadius; ++n) {
        padded[n] = corrected[0];
        corrected[width + n] = corrected[width - 1];
    }
}

/// Sums of kDiameter neighbours along the row.
FACESCAN_KERNEL void sumAlongRow(const std::uint16_t* __restrict padded, int width,
                                 std::uint16_t* __restrict sums) {
    for (int x = 0; x < width; ++x) {
        sums[x] = std::uint16_t(padded[x] + padded[x + 1] + padded[x + 2] + padded[x + 3] +
                                padded[x + 4]);
    }
}

/// Adds a row that the filter reaches and takes away the one that it leaves.
FACESCAN_KERNEL void moveDown(const std::uint16_t* __restrict enters,
                              const std::uint16_t* __restrict leaves, int width,
                              std::uint16_t* __restrict sums) {
    for (int x = 0; x < width; ++x) sums[x] = std::uint16_t(sums[x] + enters[x] - leaves[x]);
}

/// The sum below which `share` of all counted pixels lie.
int quantile(const std::vector<std::uint32_t>& histogram, std::size_t pixels, double share) {
    const auto wanted = std::size_t(double(pixels) * share);
    std::size_t below = 0;
    for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
        below += histogram[bin];
        if (below > wanted) return int(bin) << kBinShift;
    }
    return 0xFFFF;
}

/// Maps low … high to 0 … 255.
FACESCAN_KERNEL void stretchRow(const std::uint16_t* __restrict sums, int width, std::uint32_t low,
                                std::uint32_t high, std::uint8_t* __restrict grey) {
    const std::uint32_t range = high - low;
    const std::uint32_t scale = (255u << 16) / range;
    for (int x = 0; x < width; ++x) {
        const std::uint32_t sum = sums[x];
        const std::uint32_t above = std::min(sum > low ? sum - low : 0u, range);
        grey[x] = std::uint8_t((above * scale + 0x8000u) >> 16);
    }
}

void stretch(const std::vector<std::uint16_t>& sums, std::vector<std::uint32_t>& histogram,
             GreyImage& texture) {
    // Some hundred rows tell the quantiles as well as all.
    constexpr int kEnoughRows = 256;
    const int step = 1 + texture.height / kEnoughRows;
    histogram.assign(0x10000 >> kBinShift, 0);
    std::size_t counted = 0;
    for (int y = 0; y < texture.height; y += step, counted += texture.width) {
        const std::uint16_t* row = sums.data() + std::size_t(y) * texture.width;
        for (int x = 0; x < texture.width; ++x) ++histogram[row[x] >> kBinShift];
    }
    const int low = quantile(histogram, counted, 0.005);
    const int high = std::max(quantile(histogram, counted, 0.995), low + 1);
    for (int y = 0; y < texture.height; ++y) {
        stretchRow(sums.data() + std::size_t(y) * texture.width, texture.width, std::uint32_t(low),
                   std::uint32_t(high), texture.row(y));
    }
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
    if (scratch.gamma != gamma) {
        scratch.gamma = gamma;
        scratch.table = gammaTable(gamma);
    }
    scratch.corrected.resize(std::size_t(width) + 2 * kRadius);
    // From the row that the filter leaves to the one that it reaches.
    constexpr int kRows = kDiameter + 1;
    scratch.row_sums.resize(std::size_t(width) * kRows);
    scratch.filtered.resize(pixels);
    const auto row_sums = [&](int y) {
        return scratch.row_sums.data() + std::size_t(std::clamp(y, 0, height - 1) % kRows) * width;
    };
    const auto prepare_row = [&](int y) {
        if (y >= height) return;
        correctRow(finest(false, y), finest(true, y), width, scratch.table,
                   scratch.corrected.data());
        sumAlongRow(scratch.corrected.data(), width, row_sums(y));
    };
    for (int y = 0; y < kRadius; ++y) prepare_row(y);

    scratch.column_sums.assign(width, 0);
    scratch.no_row.assign(width, 0);
    std::uint16_t* column_sums = scratch.column_sums.data();
    for (int y = -kRadius; y < kRadius; ++y) {
        moveDown(row_sums(y), scratch.no_row.data(), width, column_sums);
    }
    for (int y = 0; y < height; ++y) {
        prepare_row(y + kRadius);
        const std::uint16_t* leaves = y > 0 ? row_sums(y - kRadius - 1) : scratch.no_row.data();
        moveDown(row_sums(y + kRadius), leaves, width, column_sums);
        std::copy_n(column_sums, width, scratch.filtered.data() + std::size_t(y) * width);
    }
    stretch(scratch.filtered, scratch.histogram, texture);
}

}  // namespace facescan
