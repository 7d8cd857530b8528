#include "reconstruct/pattern.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <vector>

namespace facescan {
namespace {

/// The binary reflected Gray code by its name: the code of one bit less, then the same mirrored
/// with the new bit set.
std::vector<std::uint32_t> reflectedCode(int bits) {
    std::vector<std::uint32_t> code{0};
    for (int bit = 0; bit < bits; ++bit) {
        for (int i = int(code.size()) - 1; i >= 0; --i) code.push_back(code[i] | 1u << bit);
    }
    return code;
}

TEST(GrayCode, IsTheReflectedCode) {
    const std::vector<std::uint32_t> code = reflectedCode(kMaxBits);
    for (std::uint32_t c = 0; c < code.size(); ++c) ASSERT_EQ(grayCodeword(c), code[c]);
}

TEST(GrayCode, NeighboursDifferInOneBit) {
    for (std::uint32_t c = 1; c < 1u << kMaxBits; ++c) {
        ASSERT_EQ(std::popcount(grayCodeword(c - 1) ^ grayCodeword(c)), 1) << "stripe " << c;
    }
}

TEST(GrayCode, GivesEachStripeItsOwnCodewordAndBack) {
    std::set<std::uint32_t> codewords;
    for (std::uint32_t c = 0; c < 1u << kMaxBits; ++c) {
        codewords.insert(grayCodeword(c));
        ASSERT_EQ(grayStripe(grayCodeword(c)), c);
    }
    EXPECT_EQ(codewords.size(), 1u << kMaxBits);
    EXPECT_EQ(*codewords.rbegin(), (1u << kMaxBits) - 1);
}

TEST(Pattern, ShowsTheMostSignificantBitFirst) {
    for (int bits = kMinBits; bits <= kMaxBits; ++bits) {
        const Pattern pattern{.bits = bits};
        const std::vector<std::uint32_t> code = reflectedCode(bits);
        for (int pair = 0; pair < bits; ++pair) {
            for (std::uint32_t c = 0; c < code.size(); ++c) {
                const bool bit = code[c] & 1u << (bits - 1 - pair);
                ASSERT_EQ(pattern.lit(pair, false, c), bit) << bits << " bits, pair " << pair;
            }
        }
    }
}

TEST(Pattern, LightsAStripeInOneFrameOfEachPair) {
    const Pattern pattern{.bits = 10};
    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (int c = 0; c < pattern.stripes(); ++c) {
            ASSERT_NE(pattern.lit(pair, false, c), pattern.lit(pair, true, c));
        }
    }
}

TEST(Pattern, ShowsEachEdgeInExactlyOnePair) {
    for (int bits = kMinBits; bits <= kMaxBits; ++bits) {
        const Pattern pattern{.bits = bits};
        for (int edge = 1; edge < pattern.stripes(); ++edge) {
            for (int pair = 0; pair < bits; ++pair) {
                const bool shows =
                    pattern.lit(pair, false, edge - 1) != pattern.lit(pair, false, edge);
                ASSERT_EQ(shows, pair == pairOfEdge(edge, bits)) << "edge " << edge;
            }
        }
    }
}

TEST(Pattern, ShowsEverySecondEdgeInTheFinestPair) {
    const Pattern pattern{.bits = 8};
    EXPECT_EQ(pattern.finestPair(), 7);
    for (int edge = 1; edge < 256; edge += 2) EXPECT_EQ(pairOfEdge(edge, 8), 7);
    EXPECT_EQ(pairOfEdge(128, 8), 0);
}

TEST(Pattern, InterleavesPatternsAndComplements) {
    const Pattern pattern{.bits = 4, .order = FrameOrder::interleaved};
    std::vector<int> order;
    for (int pair = 0; pair < 4; ++pair) {
        order.push_back(pattern.frameIndex(pair, false));
        order.push_back(pattern.frameIndex(pair, true));
    }
    EXPECT_EQ(order, (std::vector{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Pattern, GroupsAllPatternsBeforeAllComplements) {
    const Pattern pattern{.bits = 4, .order = FrameOrder::grouped};
    std::vector<int> patterns, complements;
    for (int pair = 0; pair < 4; ++pair) {
        patterns.push_back(pattern.frameIndex(pair, false));
        complements.push_back(pattern.frameIndex(pair, true));
    }
    EXPECT_EQ(patterns, (std::vector{0, 1, 2, 3}));
    EXPECT_EQ(complements, (std::vector{4, 5, 6, 7}));
}

}  // namespace
}  // namespace facescan
