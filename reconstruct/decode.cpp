#include "reconstruct/decode.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace facescan {
namespace {

/// Pattern − complement and pattern + complement at a pixel, averaged over the neighbours along
/// the stripe with weights 1 2 1 (times four).
struct PixelContrast {
    int difference;
    int sum;

    float normalised() const { return sum > 0 ? float(difference) / float(sum) : 0.0f; }
};

PixelContrast contrastAt(const StripeImages& images, int pair, int x, int y) {
    const std::uint8_t* p = images.patternRow(pair, y);
    const std::uint8_t* c = images.complementRow(pair, y);
    const int left = x > 0 ? x - 1 : x;
    const int right = x + 1 < images.width ? x + 1 : x;
    const int p3 = p[left] + 2 * p[x] + p[right];
    const int c3 = c[left] + 2 * c[x] + c[right];
    return {p3 - c3, p3 + c3};
}

/// The scene's brightness and its relative change between the rows y and y + 1, from the sum of all
/// frames, where no stripe is left.
EdgeLight lightAt(const PixelPlanes& planes, int frames, int x, int y) {
    const int left = std::max(x - 1, 0);
    const int right = std::min(x + 1, planes.width - 1);
    const auto row = [&](int r) {
        return planes.brightness.data() + planes.index(0, std::clamp(r, 0, planes.height - 1));
    };
    const auto smoothed = [&](const std::uint16_t* b) { return b[left] + 2 * b[x] + b[right]; };
    const int before = smoothed(row(y - 1));
    const int upper = smoothed(row(y));
    const int lower = smoothed(row(y + 1));
    const int after = smoothed(row(y + 2));

    EdgeLight light;
    light.brightness = 0.25f * float(upper + lower) / float(frames);
    // The means of the two upper and the two lower rows belong to places two pixels apart, and so
    // do the columns left and right.
    const int sum = before + upper + lower + after;
    if (sum > 0) light.gradient_y = float(lower + after - before - upper) / float(sum);
    const int left_sum = row(y)[left] + row(y + 1)[left];
    const int right_sum = row(y)[right] + row(y + 1)[right];
    if (left_sum + right_sum > 0) {
        light.gradient_x = float(right_sum - left_sum) / float(left_sum + right_sum);
    }
    return light;
}

/// More stripes than this for each row of the image cannot be told apart; the grid, which has a row
/// for each, stays within a multiple of the frames' size.
constexpr int kMaxStripesPerRow = 20;

struct Crossing {
    float y;
    EdgeLight light;
};

/// The zero crossing of a pair's normalised frame between the rows y and y + 1: a line through
/// four pixels with the weights ½ 1 1 ½, or through the inner two where the outer two belong to
/// something else.
Crossing locateCrossing(const StripeImages& images, const PixelPlanes& planes, int pair, int x,
                        int y) {
    const PixelContrast before = contrastAt(images, pair, x, std::max(y - 1, 0));
    const PixelContrast upper = contrastAt(images, pair, x, y);
    const PixelContrast lower = contrastAt(images, pair, x, y + 1);
    const PixelContrast after = contrastAt(images, pair, x, std::min(y + 2, images.height - 1));

    EdgeLight light = lightAt(planes, 2 * images.bits, x, y);
    light.contrast = 0.25f * float(std::abs(upper.difference - lower.difference));
    light.sense = lower.difference > upper.difference ? 1.0f : -1.0f;

    const float n0 = upper.normalised();
    const float n1 = lower.normalised();
    float place = n0 / (n0 - n1);
    // Weighted mean and slope of the values at −1, 0, 1, 2, about the middle ½.
    const float mean = (0.5f * (before.normalised() + after.normalised()) + n0 + n1) / 3.0f;
    const float slope =
        (0.75f * (after.normalised() - before.normalised()) + 0.5f * (n1 - n0)) / 2.75f;
    if (y > 0 && y + 2 < images.height && slope * (n1 - n0) > 0) {
        const float four_pixels = 0.5f - mean / slope;
        if (std::fabs(four_pixels - place) < 0.5f) place = four_pixels;
    }
    return {float(y) + place, light};
}

/// The codeword around a crossing of `pair` between the rows y and y + 1, where the two pixels
/// disagree in other pairs too: each other pair by the sign of both pixels together.
std::uint32_t jointCodeword(const StripeImages& images, int pair, int x, int y) {
    std::uint32_t codeword = 0;
    for (int other = 0; other < images.bits; ++other) {
        const int sum = contrastAt(images, other, x, y).difference +
                        contrastAt(images, other, x, y + 1).difference;
        codeword = codeword * 2 + std::uint32_t(other != pair && sum > 0);
    }
    return codeword;
}

/// Whether codewords that differ in `bit` alone and agree with `codeword` elsewhere belong to
/// neighbouring stripes: in a reflected Gray code the bits below then read 10…0.
bool namesAnEdge(std::uint32_t codeword, std::uint32_t bit) {
    return (codeword & (bit - 1)) == bit >> 1;
}

void decodeGap(const StripeImages& images, const PixelPlanes& planes, int x, int y,
               std::vector<StripeEdge>& edges) {
    const std::uint32_t above = planes.codeword[planes.index(x, y)];
    const std::uint32_t below = planes.codeword[planes.index(x, y + 1)];
    const std::uint32_t changed = above ^ below;
    const bool alone = std::has_single_bit(changed);
    for (std::uint32_t rest = changed; rest != 0; rest &= rest - 1) {
        const std::uint32_t bit = rest & (0u - rest);
        const int pair = images.bits - 1 - std::countr_zero(bit);
        const std::uint32_t codeword = alone ? above : jointCodeword(images, pair, x, y);
        if (!namesAnEdge(codeword, bit)) continue;

        const std::uint32_t dark = grayStripe(codeword & ~bit);
        const std::uint32_t lit = grayStripe(codeword | bit);
        const Crossing crossing = locateCrossing(images, planes, pair, x, y);
        edges.push_back({.y = crossing.y,
                         .light = crossing.light,
                         .column = std::uint16_t(x),
                         .code = std::uint16_t(std::max(dark, lit)),
                         .rising = (lit > dark) == ((below & bit) != 0)});
    }
}

/// Where a column shows one edge twice, the one of the higher contrast stays.
void insertEdge(const StripeEdge& edge, VertexGrid& grid) {
    const std::size_t i = grid.index(edge.code, edge.column);
    if (grid.cell[i] == Cell::measured && grid.light[i].contrast >= edge.light.contrast) return;
    grid.cell[i] = Cell::measured;
    grid.y[i] = edge.y;
    grid.light[i] = edge.light;
}

}  // namespace

DecodeCounts decodeEdges(const StripeImages& images, const PixelPlanes& planes,
                         const Options& options, std::vector<StripeEdge>& edges, VertexGrid& grid) {
    DecodeCounts counts;
    edges.clear();
    for (int y = 0; y + 1 < images.height; ++y) {
        const std::uint16_t* above = planes.codeword.data() + planes.index(0, y);
        const std::uint16_t* below = above + planes.width;
        const std::uint8_t* modulation = planes.modulation.data() + planes.index(0, y);
        for (int x = 0; x < images.width; ++x) {
            if (above[x] == below[x]) continue;
            if (std::min(modulation[x], modulation[x + planes.width]) < options.min_modulation) {
                continue;
            }
            ++counts.found;
            decodeGap(images, planes, x, y, edges);
        }
    }

    const auto rising = std::count_if(edges.begin(), edges.end(),
                                      [](const StripeEdge& edge) { return edge.rising; });
    counts.rising = 2 * rising >= std::ptrdiff_t(edges.size());
    counts.decoded = int(counts.rising ? rising : std::ptrdiff_t(edges.size()) - rising);

    grid.reset(std::min(1 << images.bits, kMaxStripesPerRow * images.height), images.width);
    for (const StripeEdge& edge : edges) {
        if (edge.rising == counts.rising && edge.code < grid.codes) insertEdge(edge, grid);
    }
    return counts;
}

}  // namespace facescan
