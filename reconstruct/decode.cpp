#include "reconstruct/decode.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>

namespace facescan {
namespace {

/// More stripes than this for each row of the image cannot be told apart; the grid, which has a row
/// for each, stays within a multiple of the frames' size.
constexpr int kMaxStripesPerRow = 20;

/// Left neighbour, right neighbour, both inside the row.
struct Beside {
    int left;
    int right;

    Beside(int x, int width) : left(x > 0 ? x - 1 : x), right(x + 1 < width ? x + 1 : x) {}
};

/// P − C at a pixel, smoothed along the stripe with weights 1 2 1.
int differenceAt(const std::uint8_t* p, const std::uint8_t* c, int x, const Beside& side) {
    return p[side.left] + 2 * p[x] + p[side.right] - c[side.left] - 2 * c[x] - c[side.right];
}

/// Gathers what edges show, batch by batch, and lays what the kernel makes of it into the grid.
class EdgeLocator {
public:
    EdgeLocator(const StripeImages& images, const PixelPlanes& planes, EdgeBatch& batch,
                VertexGrid& grid)
        : images_(images), planes_(planes), batch_(batch), grid_(grid) {
        batch_.count = 0;
    }

    /// The edge of `code` between the rows y and y + 1, which shows in `pair`.
    void add(int pair, int code, int x, int y) {
        const bool inside = y > 0 && y + 2 < images_.height;
        const bool within = x > 0 && x + 1 < images_.width;
        if (inside && within) {
            gather(pair, x, y, {-1, 1}, {-1, 0, 1, 2});
        } else {
            const int last = images_.height - 1;
            gather(pair, x, y, {x > 0 ? -1 : 0, x + 1 < images_.width ? 1 : 0},
                   {y > 0 ? -1 : 0, 0, 1, y + 2 <= last ? 2 : 1});
        }
        const int n = batch_.count;
        batch_.inside[n] = inside;
        batch_.column[n] = std::uint16_t(x);
        batch_.code[n] = std::uint16_t(code);
        batch_.row[n] = y;
        if (++batch_.count == EdgeBatch::kSize) flush();
    }

    void flush() {
        kernels().locateEdges(batch_, float(2 * images_.bits));
        for (int n = 0; n < batch_.count; ++n) insert(n);
        batch_.count = 0;
    }

private:
    /// @param side   offsets of the columns to either side
    /// @param lines  offsets of the four rows around the gap below y
    void gather(int pair, int x, int y, const std::array<int, 2>& side,
                const std::array<int, 4>& lines) {
        const int n = batch_.count;
        const std::uint8_t* p = images_.patternRow(pair, y) + x;
        const std::uint8_t* c = images_.complementRow(pair, y) + x;
        const std::uint16_t* b = planes_.brightness.data() + planes_.index(x, y);
        for (int r = 0; r < 4; ++r) {
            const std::ptrdiff_t line = lines[r] * images_.row_stride;
            const int p3 = p[line + side[0]] + 2 * p[line] + p[line + side[1]];
            const int c3 = c[line + side[0]] + 2 * c[line] + c[line + side[1]];
            batch_.difference[r][n] = p3 - c3;
            batch_.sum[r][n] = p3 + c3;
            const std::uint16_t* here = b + std::ptrdiff_t(lines[r]) * planes_.width;
            batch_.brightness[r][n] = here[side[0]] + 2 * here[0] + here[side[1]];
        }
        const std::uint16_t* below = b + planes_.width;
        batch_.brightness_left[n] = b[side[0]] + below[side[0]];
        batch_.brightness_right[n] = b[side[1]] + below[side[1]];
    }

    /// Where a column shows one edge twice, the one of the higher contrast stays.
    void insert(int n) {
        const int column = batch_.column[n];
        const std::size_t i = grid_.index(batch_.code[n], column);
        if (grid_.cell[i] == Cell::measured && grid_.contrast[i] >= batch_.contrast[n]) return;
        Extent& extent = grid_.extent[batch_.code[n]];
        extent.first = std::min(extent.first, column);
        extent.end = std::max(extent.end, column + 1);
        grid_.cell[i] = Cell::measured;
        grid_.y[i] = float(batch_.row[n]) + batch_.place[n];
        grid_.contrast[i] = batch_.contrast[n];
        grid_.gradient_x[i] = batch_.gradient_x[n];
        grid_.gradient_y[i] = batch_.gradient_y[n];
        grid_.drift_gain[i] = batch_.drift_gain[n];
    }

    const StripeImages& images_;
    const PixelPlanes& planes_;
    EdgeBatch& batch_;
    VertexGrid& grid_;
};

/// Walks over the classified gaps between rows, and names the edges in them.
class EdgeReader {
public:
    EdgeReader(const StripeImages& images, const PixelPlanes& planes, bool rising,
               EdgeLocator& locator, int codes)
        : images_(images), planes_(planes), rising_(rising), locator_(locator), codes_(codes) {}

    /// @returns how many edges of the row run with the device
    int readRow(const std::uint8_t* edge_class, int y) {
        const std::uint8_t wanted = rising_ ? kRisingEdge : kFallingEdge;
        const std::uint16_t* above = planes_.stripe.data() + planes_.index(0, y);
        int decoded = 0;
        for (int first = 0; first < images_.width; first += kGroup) {
            const int count = std::min(kGroup, images_.width - first);
            std::uint64_t any = 0;
            std::memcpy(&any, edge_class + first, count);
            if (any == 0) continue;
            // Collected without a branch for each pixel, which none could predict.
            std::array<int, kGroup> places;
            std::array<int, kGroup> ambiguous_places;
            int edges = 0;
            int ambiguous = 0;
            for (int x = first; x < first + count; ++x) {
                places[edges] = x;
                edges += edge_class[x] == wanted;
                ambiguous_places[ambiguous] = x;
                ambiguous += edge_class[x] == kAmbiguousEdge;
            }
            for (int n = 0; n < edges; ++n) {
                const int code = above[places[n]] + int(rising_);
                decoded += add(pairOfEdge(code, images_.bits), code, places[n], y);
            }
            for (int n = 0; n < ambiguous; ++n) decoded += readAmbiguous(ambiguous_places[n], y);
        }
        return decoded;
    }

private:
    static constexpr int kGroup = 8;

    int add(int pair, int code, int x, int y) {
        if (code < codes_) locator_.add(pair, code, x, y);
        return 1;
    }

    /// Where the two pixels disagree in more pairs than one, each of these is a place where an edge
    /// can be: it is one if the other pairs, by both pixels together, name it.
    int readAmbiguous(int x, int y) {
        const std::size_t i = planes_.index(x, y);
        const std::uint32_t above = grayCodeword(planes_.stripe[i]);
        const std::uint32_t below = grayCodeword(planes_.stripe[i + planes_.width]);
        const std::uint32_t changed = above ^ below;
        if (std::has_single_bit(changed) || spansAJump(x, y)) return 0;
        int decoded = 0;
        for (std::uint32_t rest = changed; rest != 0; rest &= rest - 1) {
            const std::uint32_t bit = rest & (0u - rest);
            const int pair = images_.bits - 1 - std::countr_zero(bit);
            const std::uint32_t codeword = jointCodeword(x, y, y + 1, pair);
            if (!namesAnEdge(codeword, bit)) continue;
            const std::uint32_t dark = grayStripe(codeword & ~bit);
            const std::uint32_t lit = grayStripe(codeword | bit);
            if (((lit > dark) == ((below & bit) != 0)) != rising_) continue;
            decoded += add(pair, int(std::max(dark, lit)), x, y);
        }
        return decoded;
    }

    /// Whether a surface ends between the rows y and y + 1: the two pixels above and the two below
    /// are more than two stripes apart, and agree about it. Where the pixels of noisy frames
    /// disagree, one of them is alone.
    bool spansAJump(int x, int y) const {
        const std::size_t i = planes_.index(x, y);
        if (std::abs(planes_.stripe[i] - planes_.stripe[i + planes_.width]) <= 2) return false;
        const int upper = jointStripe(x, std::max(y - 1, 0), y);
        const int lower = jointStripe(x, y + 1, std::min(y + 2, images_.height - 1));
        return std::abs(upper - lower) > 3;
    }

    /// The stripe that two pixels of a column show together.
    int jointStripe(int x, int a, int b) const {
        return int(grayStripe(jointCodeword(x, a, b, -1)));
    }

    /// The codeword that the pixels in the rows a and b of a column show together: each pair by the
    /// sign of both; that of the pair `without` is left at 0.
    std::uint32_t jointCodeword(int x, int a, int b, int without) const {
        const Beside side(x, images_.width);
        std::uint32_t codeword = 0;
        for (int pair = 0; pair < images_.bits; ++pair) {
            int difference = 0;
            for (const int row : {a, b}) {
                difference += differenceAt(images_.patternRow(pair, row),
                                           images_.complementRow(pair, row), x, side);
            }
            codeword = codeword * 2 + std::uint32_t(pair != without && difference > 0);
        }
        return codeword;
    }

    /// Whether codewords that differ in `bit` alone and agree with `codeword` elsewhere belong to
    /// neighbouring stripes: in a reflected Gray code the bits below then read 10…0.
    static bool namesAnEdge(std::uint32_t codeword, std::uint32_t bit) {
        return (codeword & (bit - 1)) == bit >> 1;
    }

    const StripeImages& images_;
    const PixelPlanes& planes_;
    bool rising_;
    EdgeLocator& locator_;
    int codes_;
};

}  // namespace

DecodeCounts decodeEdges(const StripeImages& images, const PixelPlanes& planes,
                         const Options& options, DecodeScratch& scratch, VertexGrid& grid) {
    const int width = images.width;
    const int gaps = images.height - 1;
    scratch.edge_class.resize(std::size_t(width) * gaps);
    EdgeCounts counts;
    for (int y = 0; y < gaps; ++y) {
        const std::uint16_t* stripe = planes.stripe.data() + planes.index(0, y);
        const std::uint8_t* modulation = planes.modulation.data() + planes.index(0, y);
        const EdgeCounts row = kernels().classifyEdges(
            stripe, stripe + width, modulation, modulation + width, options.min_modulation, width,
            scratch.edge_class.data() + std::size_t(y) * width);
        counts.found += row.found;
        counts.rising += row.rising;
        counts.falling += row.falling;
    }

    DecodeCounts result{.found = counts.found, .rising = counts.rising >= counts.falling};
    grid.reset(std::min(1 << images.bits, kMaxStripesPerRow * images.height), width);
    EdgeLocator locator(images, planes, scratch.batch, grid);
    EdgeReader reader(images, planes, result.rising, locator, grid.codes);
    for (int y = 0; y < gaps; ++y) {
        result.decoded += reader.readRow(scratch.edge_class.data() + std::size_t(y) * width, y);
    }
    locator.flush();
    return result;
}

}  // namespace facescan
