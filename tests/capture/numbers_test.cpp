#include "capture/numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace facescan {
namespace {

TEST(ParseWholeNumber, TakesDecimalDigitsWithASign) {
    EXPECT_EQ(parseWholeNumber<int>("0"), 0);
    EXPECT_EQ(parseWholeNumber<int>("16"), 16);
    EXPECT_EQ(parseWholeNumber<int>("-7"), -7);
    EXPECT_EQ(parseWholeNumber<int>("+7"), 7);
    EXPECT_EQ(parseWholeNumber<int>("007"), 7);
    EXPECT_EQ(parseWholeNumber<int>("2147483647"), 2147483647);
}

class NoWholeNumber : public testing::TestWithParam<const char*> {};

TEST_P(NoWholeNumber, IsRefused) {
    EXPECT_EQ(parseWholeNumber<int>(GetParam()), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(ParseWholeNumber, NoWholeNumber,
                         testing::Values("", " ", "x", "16 ", " 16", "16px", "1e3", "8.0", "0x10",
                                         "+", "-", "--1", "+-1", "++1", "1,000", "2147483648",
                                         "99999999999999999999"));

TEST(ParseDecimal, TakesFractionsAndExponents) {
    EXPECT_EQ(parseDecimal("0"), 0.0);
    EXPECT_EQ(parseDecimal("-1.5"), -1.5);
    EXPECT_EQ(parseDecimal("+1.5"), 1.5);
    EXPECT_EQ(parseDecimal(".5"), 0.5);
    EXPECT_EQ(parseDecimal("5."), 5.0);
    EXPECT_EQ(parseDecimal("25e-2"), 0.25);
    EXPECT_EQ(parseDecimal("5E+1"), 50.0);
    EXPECT_EQ(parseDecimal("1.7976931348623157e308"), std::numeric_limits<double>::max());
    EXPECT_EQ(parseDecimal("5e-324"), std::numeric_limits<double>::denorm_min());
}

class NoDecimal : public testing::TestWithParam<const char*> {};

TEST_P(NoDecimal, IsRefused) {
    EXPECT_EQ(parseDecimal(GetParam()), std::nullopt);
}

INSTANTIATE_TEST_SUITE_P(ParseDecimal, NoDecimal,
                         testing::Values("", " ", ".", "+", "-", "1 ", " 1", "1.5mm", "1,5", "1e",
                                         "1e+", "e5", "1d5", "0x10", "0x1p3", "inf", "-inf", "+inf",
                                         "infinity", "INF", "nan", "-nan", "NaN", "nan(0)", "1e309",
                                         "-1e309", "+-1", "++1", "1.2.3"));

TEST(FormatDecimal, IsTheShortestTextThatReadsAsTheSameValue) {
    EXPECT_EQ(formatDecimal(0), "0");
    EXPECT_EQ(formatDecimal(0.1), "0.1");
    EXPECT_EQ(formatDecimal(-400), "-400");
    EXPECT_EQ(formatDecimal(1e-7), "1e-07");
    EXPECT_EQ(formatDecimal(1.0 / 3), "0.3333333333333333");
}

TEST(FormatDecimal, HoldsTheLongestNumber) {
    const double longest = -2.2250738585072014e-308;
    EXPECT_EQ(parseDecimal(formatDecimal(longest)), longest);
}

}  // namespace
}  // namespace facescan
