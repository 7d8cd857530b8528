#include "reconstruct/kernels/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "reconstruct/window_fit.h"

namespace facescan {
namespace {

// Every kernel, in every form that this build holds, against the plain one: the same bits, over
// counts around the width of a register and rows that begin off any alignment.

constexpr int kRoom = 160;  // of a row: what is read beside the counted cells, too

struct Form {
    const char* name;
    const Kernels* kernels;
};

void PrintTo(const Form& form, std::ostream* out) {
    *out << form.name;
}

std::vector<Form> forms() {
    std::vector<Form> all{{"Portable", &portableKernels()}};
    if (neonKernels()) all.push_back({"Neon", neonKernels()});
    return all;
}

struct Case {
    int count;
    int offset;  ///< of the row's beginning
};

class KernelsIn : public testing::TestWithParam<Form> {
protected:
    const Kernels& form() const { return *GetParam().kernels; }
    const Kernels& plain() const { return plainKernels(); }

    static std::vector<Case> cases() {
        std::vector<Case> all;
        for (const int count : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33}) {
            for (const int offset : {0, 1, 3}) all.push_back({count, offset});
        }
        return all;
    }

    std::vector<float> floats(double low, double high) {
        std::uniform_real_distribution<float> distribution{float(low), float(high)};
        std::vector<float> values(kRoom);
        for (float& value : values) value = distribution(random_);
        return values;
    }
    template <typename T>
    std::vector<T> integers(int low, int high) {
        std::uniform_int_distribution<int> distribution(low, high);
        std::vector<T> values(kRoom);
        for (T& value : values) value = T(distribution(random_));
        return values;
    }
    std::vector<std::uint8_t> flags() { return integers<std::uint8_t>(0, 1); }
    PointPlanes points(double low, double high) {
        return {floats(low, high), floats(low, high), floats(low, high)};
    }

private:
    std::mt19937 random_{7};
};

/// Bits, so that −0 differs from 0 and NaN equals itself.
std::vector<std::uint32_t> bits(const std::vector<float>& values) {
    std::vector<std::uint32_t> all;
    for (const float value : values) all.push_back(std::bit_cast<std::uint32_t>(value));
    return all;
}
std::vector<std::uint32_t> bits(const PointPlanes& points) {
    std::vector<std::uint32_t> all;
    for (const std::vector<float>* plane : {&points.x, &points.y, &points.z}) {
        const std::vector<std::uint32_t> part = bits(*plane);
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

PointPlanes noPoints() {
    PointPlanes points;
    points.clear(kRoom);
    return points;
}

TEST_P(KernelsIn, AddPairs) {
    for (const Case& c : cases()) {
        const auto pattern = integers<std::uint8_t>(0, 255);
        const auto complement = integers<std::uint8_t>(0, 255);
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint16_t> words(2 * kRoom);
            std::vector<std::uint8_t> bytes(2 * kRoom);
            const PixelRow row{&words[c.offset], &words[kRoom + c.offset], &bytes[c.offset],
                               &bytes[kRoom + c.offset]};
            kernel.startRow(c.count, row);
            PairRows pairs{.count = 3};
            for (int pair = 0; pair < pairs.count; ++pair) {
                pairs.pattern[pair] = &pattern[c.offset + pair];
                pairs.complement[pair] = &complement[c.offset + 2 * pair];
            }
            kernel.addPairs(pairs, c.count, row);
            const int saturated = kernel.finishRow(c.count, row);
            return std::tuple{words, bytes, saturated};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " pixels";
    }
}

TEST_P(KernelsIn, ClassifyEdges) {
    for (const Case& c : cases()) {
        const auto above = integers<std::uint16_t>(126, 130);
        const auto below = integers<std::uint16_t>(126, 130);
        const auto modulation = integers<std::uint8_t>(0, 20);
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint8_t> classes(kRoom);
            const EdgeCounts counts =
                kernel.classifyEdges(&above[c.offset], &below[c.offset], &modulation[c.offset],
                                     &modulation[c.offset + 1], 6, c.count, &classes[c.offset]);
            return std::tuple{classes, counts.found, counts.rising, counts.falling,
                              counts.ambiguous};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " pixels";
    }
}

/// What is gathered of edges, or what is known of them in the end.
auto gathered(const EdgeBatch& batch) {
    return std::tuple{batch.difference, batch.sum, batch.brightness, batch.brightness_left,
                      batch.brightness_right};
}

TEST_P(KernelsIn, GatherEdges) {
    for (const int first : {0, 1, 5, EdgeBatch::kSize - EdgeRun::kMost}) {
        const auto pattern = integers<std::uint8_t>(0, 255);
        const auto complement = integers<std::uint8_t>(0, 255);
        const auto brightness = integers<std::uint16_t>(0, 24 * 255);
        EdgeRun edges{&pattern[40],
                      &complement[39],
                      {-13, 0, 13, 26},
                      &brightness[41],
                      {-11, 0, 11, 22},
                      -1,
                      1};
        const auto run = [&](const Kernels& kernel) {
            EdgeBatch batch{};
            kernel.gatherEdges(edges, first, batch);
            return batch;
        };
        const EdgeBatch batch = run(form());
        EXPECT_EQ(gathered(batch), gathered(run(plain()))) << "from edge " << first;
        for (int n = 0; n < EdgeRun::kMost; ++n) {
            const auto smoothed = [&](const auto& row, int at) {
                return row[at + n - 1] + 2 * row[at + n] + row[at + n + 1];
            };
            EXPECT_EQ(batch.difference[2][first + n],
                      smoothed(pattern, 53) - smoothed(complement, 52));
            EXPECT_EQ(batch.sum[3][first + n], smoothed(pattern, 66) + smoothed(complement, 65));
            EXPECT_EQ(batch.brightness[0][first + n], smoothed(brightness, 30));
            EXPECT_EQ(batch.brightness_right[first + n],
                      brightness[41 + n + 1] + brightness[52 + n + 1]);
        }
    }
}

TEST_P(KernelsIn, LocateEdges) {
    for (const int count : {1, 3, 4, 5, 7, 8, 9, EdgeBatch::kSize}) {
        EdgeBatch batch{};
        const auto fill = [&](auto& column, int low, int high) {
            const auto values = integers<std::int32_t>(low, high);
            std::copy_n(values.begin(), column.size(), column.begin());
        };
        for (int r = 0; r < 4; ++r) {
            fill(batch.difference[r], r < 2 ? -400 : 1, r < 2 ? 0 : 400);
            fill(batch.sum[r], 0, 2000);
            fill(batch.brightness[r], 0, 16000);
        }
        fill(batch.brightness_left, 0, 8000);
        fill(batch.brightness_right, 0, 8000);
        fill(batch.inside, 0, 1);
        fill(batch.row, 0, 1000);
        batch.count = count;
        EdgeBatch expected = batch;
        plain().locateEdges(expected, 16);
        form().locateEdges(batch, 16);
        const auto same = [&](const auto& a, const auto& b) {
            return std::equal(a.begin(), a.begin() + count, b.begin(), [](float x, float y) {
                return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
            });
        };
        EXPECT_TRUE(same(batch.place, expected.place)) << count << " edges";
        EXPECT_TRUE(same(batch.contrast, expected.contrast));
        EXPECT_TRUE(same(batch.gradient_x, expected.gradient_x));
        EXPECT_TRUE(same(batch.gradient_y, expected.gradient_y));
        EXPECT_TRUE(same(batch.drift_gain, expected.drift_gain));
    }
}

TEST_P(KernelsIn, LayEdges) {
    for (int count = 1; count <= EdgeRun::kMost; ++count) {
        EdgeBatch batch{};
        for (EdgeBatch::Column<float>* column : {&batch.place, &batch.contrast, &batch.gradient_x,
                                                 &batch.gradient_y, &batch.drift_gain}) {
            const auto values = floats(0, 10);
            std::copy_n(values.begin(), column->size(), column->begin());
        }
        const auto measured = flags();
        const std::array planes{floats(0, 10), floats(0, 10), floats(0, 10), floats(0, 10),
                                floats(0, 10)};
        const int at = 7;
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint8_t> m = measured;
            auto p = planes;
            kernel.layEdges(batch, count, count,
                            {&m[at], &p[0][at], &p[1][at], &p[2][at], &p[3][at], &p[4][at]});
            return std::pair{m, p};
        };
        const auto [m, p] = run(form());
        EXPECT_EQ(std::pair(m, p), run(plain())) << count << " edges";
        for (int x = 0; x < kRoom; ++x) {
            const int n = x - at;
            const bool laid =
                n >= 0 && n < count && !(measured[x] && planes[1][x] >= batch.contrast[count + n]);
            EXPECT_EQ(m[x], measured[x] || laid) << x;
            EXPECT_EQ(p[0][x], laid ? batch.place[count + n] : planes[0][x]) << x;
            EXPECT_EQ(p[4][x], laid ? batch.drift_gain[count + n] : planes[4][x]) << x;
        }
    }
}

TEST_P(KernelsIn, LinkNeighboursAndRejectWhatTheyDoNotSupport) {
    for (const Case& c : cases()) {
        const auto y = floats(100, 104);
        const auto next = floats(103, 112);
        const auto measured = flags();
        const auto next_measured = flags();
        const auto from_before = flags();
        const int first = c.offset + kLargestGap;
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint8_t> out(4 * kRoom);
            const RowLinks links{{&out[0], &out[kRoom], &out[2 * kRoom]}, &out[3 * kRoom]};
            kernel.linkNeighbours({y.data(), next.data(), measured.data(), next_measured.data()},
                                  {2, 2, 8, 1}, first, first + c.count, links);
            std::vector<std::uint8_t> kept(kRoom);
            const int rejected = kernel.rejectUnsupported(
                links, from_before.data(), measured.data(), first, first + c.count, kept.data());
            return std::tuple{out, kept, rejected};
        };
        const auto [links, kept, rejected] = run(form());
        EXPECT_EQ(std::tuple(links, kept, rejected), run(plain())) << c.count << " cells";
        for (int x = first; x < first + c.count; ++x) {
            // Linked is the next measured cell alone.
            int gap = 1;
            while (gap <= kLargestGap && !measured[x + gap]) ++gap;
            for (int n = 1; n <= kLargestGap; ++n) {
                const bool near = std::abs(y[x + n] - y[x]) <= 2.0f * float(n);
                EXPECT_EQ(links[std::size_t(n - 1) * kRoom + x], measured[x] && n == gap && near);
            }
        }
    }
}

TEST_P(KernelsIn, TurnEdgesIntoPoints) {
    for (const Case& c : cases()) {
        const auto across = floats(-1, 1);
        const auto y = floats(0, 700);
        const EdgeRow row{&across[c.offset], &y[c.offset], 0.5f, 380, 1.0f / 380};
        const DeviceRow device{{0.21f, 0.001f, -0.002f}, {0.002f, 0.33f, 0.01f},
                               {-0.08f, 0.03f, 0},       {1e-3f, -5e-4f},
                               {0.001f, 0.009f, 0.002f}, 1.1f};
        const auto by_device = [&](const Kernels& kernel) {
            PointPlanes out = noPoints();
            kernel.deviceRow(device, row, c.count, rowFrom(out, c.offset));
            return bits(out);
        };
        EXPECT_EQ(by_device(form()), by_device(plain())) << c.count << " cells";
        std::vector<float> terms;
        for (int term = 0; term < 3 * 21; ++term) {
            const auto plane = floats(-30, 30);
            terms.insert(terms.end(), plane.begin(), plane.end());
        }
        const PolynomialRow polynomial{5, 0.3f, &terms[c.offset], kRoom, 21 * kRoom};
        const auto by_polynomial = [&](const Kernels& kernel) {
            PointPlanes out = noPoints();
            kernel.polynomialRow(polynomial, row, c.count, rowFrom(out, c.offset));
            return bits(out);
        };
        EXPECT_EQ(by_polynomial(form()), by_polynomial(plain())) << c.count << " cells";
    }
}

TEST_P(KernelsIn, FindReferencePlanesAndMoveEdges) {
    for (const Case& c : cases()) {
        const PointPlanes above = points(0, 50);
        const PointPlanes below = points(0, 50);
        const PointPlanes here = points(0, 2);
        const PointPlanes ahead = points(0, 2);
        const auto known = flags();
        const auto beyond = flags();
        const auto places = floats(100, 102);
        const int at = c.offset + 4;
        const auto run = [&](const Kernels& kernel) {
            PointPlanes normal = noPoints();
            std::vector<float> mm_per_px(kRoom);
            std::vector<float> shift(kRoom);
            std::vector<std::uint8_t> useful = known;
            const ReferencePlaneRow planes{rowFrom(normal, at), &mm_per_px[at], &useful[at]};
            kernel.referencePlanes({.above = rowFrom(above, at),
                                    .below = rowFrom(below, at),
                                    .here = rowFrom(here, 0),
                                    .ahead = rowFrom(ahead, 0),
                                    .reach = 4,
                                    .least_mm_per_px = 0.15f,
                                    .above_y = &places[at],
                                    .below_y = &places[at + 1],
                                    .beyond_above_y = &places[at + 2],
                                    .beyond_below_y = &places[at + 3],
                                    .beyond_above = &beyond[at],
                                    .beyond_below = &beyond[at + 1],
                                    .largest_jump = 1.5f,
                                    .largest_bend = 1},
                                   c.count, planes);
            kernel.compensateRow(
                rowFrom(above, at), {planes.normal, planes.mm_per_px, planes.known},
                {{10, 20, 30}, {0.1f, -0.2f, 0.3f}, {0.01f, 0.02f, -0.01f}}, c.count, &shift[at]);
            return std::tuple{bits(normal), bits(mm_per_px), bits(shift), useful};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " cells";
    }
}

TEST_P(KernelsIn, SumEquations) {
    for (const int count : {8, 16, 24, 64}) {
        std::array<std::vector<float>, 6> rows;
        AlignmentBatch batch{};
        for (int k = 0; k < 6; ++k) {
            rows[k] = floats(-50, 50);
            batch.row[k] = rows[k].data();
        }
        const auto distance = floats(-1, 1);
        batch.distance = distance.data();
        batch.count = count;
        const auto run = [&](const Kernels& kernel) {
            SixSums sums;
            kernel.sumAlignment(batch, {1e-3f, 2e-3f, -1e-3f, 1e-4f, 0, 2e-4f}, 0.7f, sums);
            return sums;
        };
        const SixSums a = run(form());
        const SixSums b = run(plain());
        EXPECT_EQ(a.products, b.products) << count << " equations";
        EXPECT_EQ(a.right, b.right);
        EXPECT_EQ(a.residuals, b.residuals);
    }
}

TEST_P(KernelsIn, RegisterPixels) {
    for (const int count : {8, 24, 64}) {
        const auto level = floats(0, 1);
        const auto gradient_x = floats(-0.1, 0.1);
        const auto gradient_y = floats(-0.1, 0.1);
        const auto lever_x = floats(-60, 60);
        const auto lever_y = floats(-60, 60);
        const RegistrationPixels pixels{
            count,          level.data(),  gradient_x.data(), gradient_y.data(),
            lever_x.data(), lever_y.data()};
        std::array<std::vector<std::int32_t>, 4> levels;
        for (auto& plane : levels) plane = integers<std::int32_t>(0, 30000);
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::int32_t> x(kRoom), y(kRoom);
            std::vector<float> part_x(kRoom), part_y(kRoom), weight(kRoom);
            const WarpedPixels warped{
                x.data(),
                y.data(),
                part_x.data(),
                part_y.data(),
                weight.data(),
                {levels[0].data(), levels[1].data(), levels[2].data(), levels[3].data()}};
            kernel.warpPixels(pixels, {1.3f, -0.7f, 0.01f, 0.02f, 50, 55, 100, 110}, warped);
            SixSums sums;
            kernel.sumRegistration(pixels, warped, {1e-4f, 1.1f, 0.01f, 1.0f / 64, 0.8f}, sums);
            return std::tuple{x,
                              y,
                              bits(part_x),
                              bits(part_y),
                              bits(weight),
                              sums.products,
                              sums.right,
                              sums.residuals};
        };
        EXPECT_EQ(run(form()), run(plain())) << count << " pixels";
    }
}

TEST_P(KernelsIn, HalveAndBlur) {
    for (const Case& c : cases()) {
        const auto bytes = integers<std::uint8_t>(0, 255);
        const auto words = integers<std::uint16_t>(0, 2040);
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint16_t> halved(kRoom), blurred(kRoom);
            kernel.halveRows({&bytes[0], &bytes[1], &bytes[2], &bytes[3]}, c.count,
                             &halved[c.offset]);
            kernel.blurRows({&words[0], &words[1], &words[2]}, c.count, &blurred[c.offset]);
            return std::tuple{halved, blurred};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " pixels";
    }
}

TEST_P(KernelsIn, CutQuadsAndFindNormals) {
    for (const Case& c : cases()) {
        const PointPlanes north = points(0, 3);
        const PointPlanes south = points(1, 4);
        const auto north_y = floats(0, 6);
        const auto south_y = floats(3, 9);
        const auto north_present = flags();
        const auto south_present = flags();
        const auto run = [&](const Kernels& kernel) {
            const int at = c.offset + 1;
            std::array<std::vector<std::uint8_t>, 3> cut;
            for (auto& row : cut) row.resize(kRoom);
            std::array<std::vector<float>, 2> longest;
            for (auto& row : longest) row.resize(kRoom);
            std::array<std::vector<std::int32_t>, 2> length;
            for (auto& row : length) row.resize(kRoom);
            const QuadRows rows{rowFrom(north, at), rowFrom(south, at), &north_y[at],
                                &south_y[at],       &north_present[at], &south_present[at]};
            kernel.cutQuads(rows, 1, c.count,
                            {&cut[0][at], &cut[1][at], &cut[2][at], &longest[0][at],
                             &longest[1][at], &length[0][at], &length[1][at]});
            kernel.markShort(&longest[0][at], 4, c.count, &cut[0][at]);
            PointPlanes first = noPoints(), second = noPoints(), normals = noPoints();
            kernel.triangleNormals(rows, {&cut[0][at], &cut[1][at], &cut[2][at]}, c.count,
                                   {rowFrom(first, at), rowFrom(second, at)});
            const VertexCorners::Side side{rowFrom(first, at), rowFrom(second, at), &cut[2][at]};
            kernel.vertexNormals({side, side}, -1, c.count, rowFrom(normals, at));
            return std::tuple{cut,         bits(longest[0]), bits(longest[1]), length,
                              bits(first), bits(second),     bits(normals)};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " quads";
    }
}

TEST_P(KernelsIn, RateVerticesAndChooseWindows) {
    for (const Case& c : cases()) {
        auto contrast = floats(0, 80);
        contrast[c.offset] = 0;
        const auto run = [&](const Kernels& kernel) {
            std::vector<float> quality(kRoom);
            std::vector<std::uint8_t> window(kRoom);
            kernel.vertexQuality(&contrast[c.offset], 4, c.count, &quality[c.offset]);
            kernel.chooseWindows(&contrast[c.offset], 4, c.count, &window[c.offset]);
            return std::tuple{bits(quality), window};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " cells";
    }
}

TEST_P(KernelsIn, MarkRegularCellsAndFilterThem) {
    for (const Case& c : cases()) {
        std::array<std::vector<float>, 7> rows;
        std::vector<float> plane;
        for (auto& row : rows) {
            row = floats(100, 101);
            plane.insert(plane.end(), row.begin(), row.end());
        }
        const auto contrast = floats(1, 60);
        const auto candidates = flags();
        const int at = c.offset + 8;
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::uint8_t> regular = candidates;
            kernel.markRegular({rows[0].data(), rows[1].data(), rows[2].data(), contrast.data()},
                               {0.3f, 8}, at, at + c.count, regular.data());
            std::vector<float> filtered(3 * kRoom);
            for (int window = 0; window < 3; ++window) {
                std::vector<float> sums(kRoom), bends(kRoom);
                kernel.filterRow({&plane[3 * kRoom],
                                  kRoom,
                                  candidates.data(),
                                  {sums.data(), bends.data()},
                                  &filtered[std::size_t(window) * kRoom]},
                                 fixedFilter(window), at, at + c.count);
            }
            return std::tuple{regular, bits(filtered)};
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " cells";
    }
}

TEST_P(KernelsIn, KeepFlagsThatAllAroundHave) {
    for (const Case& c : cases()) {
        std::array<std::vector<std::uint8_t>, 3> rows;
        for (auto& row : rows) {
            row = integers<std::uint8_t>(0, 15);
            for (std::uint8_t& flag : row) flag = flag != 0;
        }
        const std::array<const std::uint8_t*, 3> pointers{rows[0].data(), rows[1].data(),
                                                          rows[2].data()};
        const int first = c.offset + 8;
        std::vector<std::uint8_t> common(kRoom);
        form().keepCommon(pointers.data(), 3, kRoom, common.data());
        for (int x = 0; x < kRoom; ++x) {
            EXPECT_EQ(common[x], rows[0][x] & rows[1][x] & rows[2][x]);
        }
        for (const int reach : {1, 4, 5, 7}) {
            std::vector<std::uint8_t> surrounded(kRoom);
            form().keepSurrounded(rows[0].data(), reach, first, first + c.count, surrounded.data());
            for (int x = 0; x < kRoom; ++x) {
                const auto begin = rows[0].begin() + std::max(x - reach, 0);
                const bool inside = x >= first && x < first + c.count;
                EXPECT_EQ(surrounded[x],
                          inside && std::all_of(begin, begin + 2 * reach + 1,
                                                [](std::uint8_t flag) { return flag != 0; }))
                    << "reach " << reach << ", column " << x << " of " << c.count;
            }
        }
    }
}

TEST_P(KernelsIn, MeasureWidthsAndRanges) {
    for (const Case& c : cases()) {
        const auto y = floats(100, 104);
        const auto next = floats(100, 112);
        const auto both = flags();
        const auto run = [&](const Kernels& kernel) {
            std::vector<std::int32_t> widths(kRoom);
            kernel.measureWidths(&y[c.offset], &next[c.offset], &both[c.offset], 8, c.count,
                                 &widths[c.offset]);
            std::vector<std::uint8_t> inside(kRoom);
            kernel.markInRange(&y[c.offset], 101, 103, c.count, &inside[c.offset]);
            return std::pair{widths, inside};
        };
        const auto [widths, inside] = run(form());
        EXPECT_EQ(std::pair(widths, inside), run(plain())) << c.count << " cells";
        for (int x = c.offset; x < c.offset + c.count; ++x) {
            const float width = std::abs(next[x] - y[x]);
            EXPECT_EQ(widths[x], both[x] && width < 8 ? int(width * kLengthUnits) : 0);
            EXPECT_EQ(inside[x], y[x] >= 101 && y[x] <= 103);
        }
    }
}

TEST_P(KernelsIn, CorrectBias) {
    for (const Case& c : cases()) {
        const auto y = floats(100, 106);
        const auto gradient_x = floats(-1, 1);
        const auto gradient_y = floats(-1, 1);
        const auto gain = floats(-2, 2);
        const auto measured = flags();
        const int at = c.offset + 1;
        const auto run = [&](const Kernels& kernel) {
            std::vector<float> corrected(kRoom);
            kernel.correctBias({&measured[at], &y[at], &gradient_x[at], &gradient_y[at], &gain[at]},
                               {0.25f, 0.1f, -0.2f}, c.count, &corrected[at]);
            return bits(corrected);
        };
        EXPECT_EQ(run(form()), run(plain())) << c.count << " edges";
    }
}

TEST_P(KernelsIn, FitWindows) {
    for (int round = 0; round < 20; ++round) {
        std::vector<float> y, present;
        for (int row = 0; row < 7; ++row) {
            auto places = floats(-0.1, 0.1);
            const auto outlier = integers<int>(0, 9);
            const auto measured = integers<int>(0, 3);
            for (int x = 0; x < kRoom; ++x) {
                const bool there = measured[x] > 0;
                const float place = 50.0f + 4.0f * float(row) + 0.1f * float(x) + places[x];
                y.push_back(there ? place + (outlier[x] == 0 ? 3.0f : 0.0f) : 0.0f);
                present.push_back(there ? 1.0f : 0.0f);
            }
        }
        for (int window = 0; window < 3; ++window) {
            FitSpan span;
            span.y = &y[3 * kRoom + 20 + round % 4];
            span.present = &present[3 * kRoom + 20 + round % 4];
            span.stride = kRoom;
            span.setWindow(kWindows[window]);
            span.fewest = 8;
            span.cutoff.fill(0.4f);
            span.wanted.fill(1);
            FitSpan expected = span;
            plain().fitWindows(expected);
            form().fitWindows(span);
            EXPECT_EQ(span.consistent, expected.consistent);
            for (int lane = 0; lane < FitSpan::kSize; ++lane) {
                EXPECT_EQ(std::bit_cast<std::uint32_t>(span.correction[lane]),
                          std::bit_cast<std::uint32_t>(expected.correction[lane]));
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, KernelsIn, testing::ValuesIn(forms()),
                         [](const auto& form) { return std::string(form.param.name); });

}  // namespace
}  // namespace facescan
