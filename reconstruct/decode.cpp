#include "reconstruct/decode.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "reconstruct/byte_group.h"

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

/// Collects runs of edges; gathers what they show, and lays what the kernels make of it into the
/// grid. The frames and the grid are larger than caches are: what a run will touch is fetched while
/// further runs are collected.
class EdgeLocator {
public:
    EdgeLocator(const StripeImages& images, const PixelPlanes& planes, EdgeBatch& batch,
                VertexGrid& grid)
        : images_(images), planes_(planes), batch_(batch), grid_(grid) {
        batch_.count = 0;
    }

    /// `count` edges of `code` between the rows y and y + 1, from the column x on, which show in
    /// `pair`.
    void add(int pair, int code, int x, int y, int count) {
        const bool roomy = x > 0 && x + EdgeRun::kMost < images_.width;
        if (!roomy && count > 1) {
            for (int n = 0; n < count; ++n) add(pair, code, x + n, y, 1);
            return;
        }
        if (batch_.count + EdgeRun::kMost > EdgeBatch::kSize) flush();
        runs_[run_count_++] = {pair, code, x, y, count, roomy};
        batch_.count += count;
        // The rows before were there for the edges of the row above.
        const int last = std::min(y + 2, images_.height - 1);
        __builtin_prefetch(images_.patternRow(pair, last) + x);
        __builtin_prefetch(images_.complementRow(pair, last) + x);
        const std::size_t i = grid_.index(code, x);
        for (std::vector<float>* plane :
             {&grid_.y, &grid_.contrast, &grid_.gradient_x, &grid_.gradient_y, &grid_.drift_gain}) {
            __builtin_prefetch(plane->data() + i, 1);
        }
    }

    void flush() {
        forEachRun([&](const Run& run, int lane) { gather(run, lane); });
        kernels().locateEdges(batch_, float(2 * images_.bits));
        forEachRun([&](const Run& run, int lane) { lay(run, lane); });
        batch_.count = 0;
        run_count_ = 0;
    }

private:
    struct Run {
        int pair;
        int code;
        int column;
        int row;
        int count;
        bool roomy;  ///< all columns of a whole run, and those beside, are in the image
    };

    /// Calls visit(run, lane) with the runs and where the edges of each begin in the batch.
    template <typename Visit>
    void forEachRun(Visit visit) {
        int lane = 0;
        for (int n = 0; n < run_count_; ++n) {
            visit(runs_[n], lane);
            lane += runs_[n].count;
        }
    }

    void gather(const Run& run, int lane) {
        const int x = run.column;
        const int y = run.row;
        const bool inside = y > 0 && y + 2 < images_.height;
        EdgeRun edges;
        edges.pattern = images_.patternRow(run.pair, y) + x;
        edges.complement = images_.complementRow(run.pair, y) + x;
        edges.brightness = planes_.brightness.data() + planes_.index(x, y);
        edges.left = x > 0 ? -1 : 0;
        edges.right = x + 1 < images_.width ? 1 : 0;
        const std::array<int, 4> rows{y > 0 ? -1 : 0, 0, 1, y + 2 < images_.height ? 2 : 1};
        for (int r = 0; r < 4; ++r) {
            edges.rows[r] = rows[r] * images_.row_stride;
            edges.brightness_rows[r] = std::ptrdiff_t(rows[r]) * planes_.width;
        }
        if (run.roomy) {
            kernels().gatherEdges(edges, lane, batch_);
        } else {
            gatherOne(edges, lane);
        }
        std::fill_n(batch_.inside.begin() + lane, EdgeRun::kMost, inside);
        std::fill_n(batch_.row.begin() + lane, EdgeRun::kMost, float(y));
    }

    /// At the image's border, where a run of full length has no room.
    void gatherOne(const EdgeRun& run, int n) {
        const auto smoothed = [&](const auto* at) {
            return at[run.left] + 2 * at[0] + at[run.right];
        };
        for (int r = 0; r < 4; ++r) {
            const int pattern = smoothed(run.pattern + run.rows[r]);
            const int complement = smoothed(run.complement + run.rows[r]);
            batch_.difference[r][n] = pattern - complement;
            batch_.sum[r][n] = pattern + complement;
            batch_.brightness[r][n] = smoothed(run.brightness + run.brightness_rows[r]);
        }
        const std::uint16_t* above = run.brightness + run.brightness_rows[1];
        const std::uint16_t* below = run.brightness + run.brightness_rows[2];
        batch_.brightness_left[n] = above[run.left] + below[run.left];
        batch_.brightness_right[n] = above[run.right] + below[run.right];
    }

    void lay(const Run& run, int lane) {
        Extent& extent = grid_.extent[run.code];
        extent.first = std::min(extent.first, run.column);
        extent.end = std::max(extent.end, run.column + run.count);
        static_assert(int(Cell::empty) == 0 && int(Cell::measured) == 1);
        const std::size_t i = grid_.index(run.code, run.column);
        kernels().layEdges(
            batch_, lane, run.count,
            {reinterpret_cast<std::uint8_t*>(&grid_.cell[i]), &grid_.y[i], &grid_.contrast[i],
             &grid_.gradient_x[i], &grid_.gradient_y[i], &grid_.drift_gain[i]});
    }

    const StripeImages& images_;
    const PixelPlanes& planes_;
    EdgeBatch& batch_;
    std::array<Run, EdgeBatch::kSize> runs_;
    int run_count_ = 0;
    VertexGrid& grid_;
};

/// Walks over the classified gaps between rows, and names the edges in them.
class EdgeReader {
public:
    EdgeReader(const StripeImages& images, const PixelPlanes& planes, const PlaceRanges& ranges,
               EdgeLocator& locator, int codes, DecodeCounts& counts)
        : images_(images),
          planes_(planes),
          ranges_(ranges),
          locator_(locator),
          codes_(codes),
          counts_(counts) {}

    /// Reads the edges that run with the device, of those whose two pixels name them.
    void readRow(const std::uint8_t* edge_class, int y) {
        const EdgeClass wanted = counts_.rising ? kRisingEdge : kFallingEdge;
        const std::uint16_t* above = planes_.stripe.data() + planes_.index(0, y);
        for (int x = 0; x < images_.width;) {
            const ByteGroup group(edge_class + x);
            if (group.allZero()) {
                x += ByteGroup::kSize;
                continue;
            }
            x += group.matches(wanted).lead();
            if (x >= images_.width) break;
            const int run =
                std::min(ByteGroup(edge_class + x).matches(wanted).run(), images_.width - x);
            int count = std::min(run, 1);
            while (count < run && above[x + count] == above[x]) ++count;
            if (count > 0) {
                const int code = above[x] + int(counts_.rising);
                add(pairOfEdge(code, images_.bits), code, x, y, count);
            }
            x += count;
        }
    }

    /// Reads the edges whose two pixels disagree in more pairs than one.
    void readAmbiguousOfRow(const std::uint8_t* edge_class, int y) {
        forEachMatch(edge_class, 0, images_.width, kAmbiguousEdge,
                     [&](int x) { readAmbiguous(x, y); });
    }

private:
    void add(int pair, int code, int x, int y, int count) {
        counts_.decoded += count;
        if (code >= codes_) return;
        if (ranges_.mayHold(code, x, y)) {
            locator_.add(pair, code, x, y, count);
        } else {
            counts_.out_of_range += count;
        }
    }

    /// Where the two pixels disagree in more pairs than one, each of these is a place where an edge
    /// can be: it is one if the other pairs, by both pixels together, name it.
    void readAmbiguous(int x, int y) {
        const std::size_t i = planes_.index(x, y);
        const std::uint32_t above = grayCodeword(planes_.stripe[i]);
        const std::uint32_t below = grayCodeword(planes_.stripe[i + planes_.width]);
        const std::uint32_t changed = above ^ below;
        const std::uint32_t joint = jointCodeword(x, y, y + 1);
        for (std::uint32_t rest = changed; rest != 0; rest &= rest - 1) {
            const std::uint32_t bit = rest & (0u - rest);
            const std::uint32_t codeword = joint & ~bit;
            if (!namesAnEdge(codeword, bit)) continue;
            const std::uint32_t dark = grayStripe(codeword);
            const std::uint32_t lit = grayStripe(codeword | bit);
            if (((lit > dark) == ((below & bit) != 0)) != counts_.rising) continue;
            if (spansAJump(x, y)) return;
            const int pair = images_.bits - 1 - std::countr_zero(bit);
            add(pair, int(std::max(dark, lit)), x, y, 1);
        }
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
    int jointStripe(int x, int a, int b) const { return int(grayStripe(jointCodeword(x, a, b))); }

    /// The codeword that the pixels in the rows a and b of a column show together: each pair by the
    /// sign of the sum of both differences, which has to be asked for only where the pixels' own
    /// signs differ.
    std::uint32_t jointCodeword(int x, int a, int b) const {
        const std::uint32_t at_a = grayCodeword(planes_.stripe[planes_.index(x, a)]);
        const std::uint32_t at_b = grayCodeword(planes_.stripe[planes_.index(x, b)]);
        std::uint32_t codeword = at_a & at_b;
        const Beside side(x, images_.width);
        for (std::uint32_t rest = at_a ^ at_b; rest != 0; rest &= rest - 1) {
            const int pair = images_.bits - 1 - std::countr_zero(rest);
            int difference = 0;
            for (const int row : {a, b}) {
                difference += differenceAt(images_.patternRow(pair, row),
                                           images_.complementRow(pair, row), x, side);
            }
            if (difference > 0) codeword |= rest & (0u - rest);
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
    const PlaceRanges& ranges_;
    EdgeLocator& locator_;
    int codes_;
    DecodeCounts& counts_;
};

}  // namespace

DecodeCounts decodeEdges(const StripeImages& images, const PixelPlanes& planes,
                         const PlaceRanges& ranges, const Options& options, DecodeScratch& scratch,
                         VertexGrid& grid) {
    const int width = images.width;
    const int gaps = images.height - 1;
    scratch.edge_class.resize(std::size_t(width) * gaps + ByteGroup::kSize);
    scratch.ambiguous.resize(gaps);
    const auto class_row = [&](int y) {
        return scratch.edge_class.data() + std::size_t(y) * width;
    };
    EdgeCounts counts;
    for (int y = 0; y < gaps; ++y) {
        const std::uint16_t* stripe = planes.stripe.data() + planes.index(0, y);
        const std::uint8_t* modulation = planes.modulation.data() + planes.index(0, y);
        const EdgeCounts row =
            kernels().classifyEdges(stripe, stripe + width, modulation, modulation + width,
                                    options.min_modulation, width, class_row(y));
        counts.found += row.found;
        counts.rising += row.rising;
        counts.falling += row.falling;
        scratch.ambiguous[y] = row.ambiguous;
    }

    DecodeCounts result{.found = counts.found, .rising = counts.rising >= counts.falling};
    grid.reset(std::min(1 << images.bits, kMaxStripesPerRow * images.height), width);
    EdgeLocator locator(images, planes, scratch.batch, grid);
    EdgeReader reader(images, planes, ranges, locator, grid.codes, result);
    for (int y = 0; y < gaps; ++y) {
        reader.readRow(class_row(y), y);
        if (scratch.ambiguous[y] > 0) reader.readAmbiguousOfRow(class_row(y), y);
    }
    locator.flush();
    return result;
}

}  // namespace facescan
