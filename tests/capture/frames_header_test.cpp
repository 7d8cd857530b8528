#include "capture/frames_header.h"

#include <gtest/gtest.h>

#include "capture/samples.h"

namespace facescan {
namespace {

using namespace test;

const std::string kFile = "scan7/frames.bin";

FramesHeader parse(const FramesHeaderBytes& bytes) {
    return parseFramesHeader(bytes, kFile);
}

TEST(FramesHeader, IsReadFieldByField) {
    const FramesHeader header = parse(sampleHeader());
    EXPECT_EQ(header.frame_count, 8);
    EXPECT_EQ(header.width, 18);
    EXPECT_EQ(header.height, 16);
    EXPECT_EQ(header.row_stride, 20);
    EXPECT_EQ(header.timing.start_time_ns, 1735689600123456789u);
    EXPECT_EQ(header.timing.frame_interval_ns, 16666667u);
    EXPECT_EQ(header.pixel_crc, slowCrc(samplePixels()));
    EXPECT_EQ(header.pixelBytes(), 8u * 16 * 20);
}

TEST(FramesHeader, IsWrittenByteForByte) {
    EXPECT_EQ(encodeFramesHeader(parse(sampleHeader())), sampleHeader());
}

TEST(CaptureTiming, DiffersWhereEitherValueDoes) {
    EXPECT_EQ((CaptureTiming{1, 2}), (CaptureTiming{1, 2}));
    EXPECT_NE((CaptureTiming{1, 2}), (CaptureTiming{3, 2}));
    EXPECT_NE((CaptureTiming{1, 2}), (CaptureTiming{1, 3}));
}

TEST(FramesHeader, CountsThePixelsOfTheLargestFileWithoutOverflow) {
    FramesHeaderBytes bytes = sampleHeader();
    putNumber(bytes, 16, 4, 1024);
    putNumber(bytes, 20, 4, 8192);
    putNumber(bytes, 24, 4, 8192);
    putNumber(bytes, 28, 4, 16384);
    renewHeaderCrc(bytes);
    EXPECT_EQ(parse(bytes).pixelBytes(), 137438953472u);
}

struct FieldCase {
    const char* field;
    std::size_t offset;
    std::size_t size;
    std::uint64_t value;
    const char* found = "";
    const char* expected = "";
};

void PrintTo(const FieldCase& c, std::ostream* out) {
    *out << c.field << " = " << c.value;
}

FramesHeaderBytes headerWith(const FieldCase& c) {
    FramesHeaderBytes bytes = sampleHeader();
    putNumber(bytes, c.offset, c.size, c.value);
    renewHeaderCrc(bytes);
    return bytes;
}

class FramesHeaderFieldAtItsLimit : public testing::TestWithParam<FieldCase> {};

TEST_P(FramesHeaderFieldAtItsLimit, IsAccepted) {
    FramesHeaderBytes bytes = headerWith(GetParam());
    EXPECT_EQ(encodeFramesHeader(parse(bytes)), bytes);
}

INSTANTIATE_TEST_SUITE_P(
    FramesHeader, FramesHeaderFieldAtItsLimit,
    testing::Values(FieldCase{"frame count", 16, 4, 1}, FieldCase{"frame count", 16, 4, 1024},
                    FieldCase{"width", 20, 4, 16}, FieldCase{"width", 20, 4, 20},
                    FieldCase{"height", 24, 4, 16}, FieldCase{"height", 24, 4, 8192},
                    FieldCase{"row stride", 28, 4, 18}, FieldCase{"row stride", 28, 4, 16384},
                    FieldCase{"start time", 32, 8, 0},
                    FieldCase{"start time", 32, 8, ~std::uint64_t(0)},
                    FieldCase{"frame interval", 40, 8, 0},
                    FieldCase{"frame interval", 40, 8, ~std::uint64_t(0)},
                    FieldCase{"pixel CRC", 48, 4, 0}, FieldCase{"pixel CRC", 48, 4, 0xffffffff}));

class FramesHeaderFieldBeyondItsLimit : public testing::TestWithParam<FieldCase> {};

TEST_P(FramesHeaderFieldBeyondItsLimit, IsRefusedByName) {
    const FieldCase& c = GetParam();
    const BundleError error = bundleErrorOf([&] { parse(headerWith(c)); });
    EXPECT_EQ(error.file(), kFile);
    EXPECT_EQ(error.field(), c.field);
    EXPECT_EQ(error.found(), c.found);
    EXPECT_EQ(error.expected(), c.expected);
}

constexpr std::uint64_t kMost = 0xffffffff;

INSTANTIATE_TEST_SUITE_P(
    FramesHeader, FramesHeaderFieldBeyondItsLimit,
    testing::Values(
        FieldCase{"magic", 7, 1, 'M', "\"FSCANBIM\"", "\"FSCANBIN\""},
        FieldCase{"magic", 0, 8, 0, R"("\x00\x00\x00\x00\x00\x00\x00\x00")", "\"FSCANBIN\""},
        FieldCase{"version", 8, 2, 0, "0", "1"}, FieldCase{"version", 8, 2, 2, "2", "1"},
        FieldCase{"version", 8, 2, 0xffff, "65535", "1"},
        FieldCase{"header size", 10, 2, 63, "63", "64"},
        FieldCase{"header size", 10, 2, 65, "65", "64"},
        FieldCase{"pixel format", 12, 4, 0x56595559, "0x56595559", "0x59455247"},
        FieldCase{"frame count", 16, 4, 0, "0", "1 to 1024"},
        FieldCase{"frame count", 16, 4, 1025, "1025", "1 to 1024"},
        FieldCase{"frame count", 16, 4, kMost, "4294967295", "1 to 1024"},
        FieldCase{"width", 20, 4, 15, "15", "16 to 8192"},
        FieldCase{"width", 20, 4, 8193, "8193", "16 to 8192"},
        FieldCase{"width", 20, 4, kMost, "4294967295", "16 to 8192"},
        FieldCase{"height", 24, 4, 15, "15", "16 to 8192"},
        FieldCase{"height", 24, 4, 8193, "8193", "16 to 8192"},
        FieldCase{"height", 24, 4, 0x80000000, "2147483648", "16 to 8192"},
        FieldCase{"row stride", 28, 4, 17, "17", "18 to 16384"},
        FieldCase{"row stride", 28, 4, 16385, "16385", "18 to 16384"},
        FieldCase{"row stride", 28, 4, kMost, "4294967295", "18 to 16384"},
        FieldCase{"reserved", 52, 1, 1, R"("\x01\x00\x00\x00\x00\x00\x00\x00")", "8 bytes of zero"},
        FieldCase{"reserved", 59, 1, 0x80, R"("\x00\x00\x00\x00\x00\x00\x00\x80")",
                  "8 bytes of zero"}));

TEST(FramesHeader, TakesTheLargestWidthWithAStrideThatHoldsIt) {
    FramesHeaderBytes bytes = sampleHeader();
    putNumber(bytes, 20, 4, 8192);
    putNumber(bytes, 28, 4, 8192);
    renewHeaderCrc(bytes);
    EXPECT_EQ(parse(bytes).width, 8192);
    EXPECT_EQ(parse(bytes).row_stride, 8192);
}

TEST(FramesHeader, WithOneBitTurnedIsRefusedWhereverItIs) {
    for (std::size_t bit = 0; bit < 8 * kFramesHeaderBytes; ++bit) {
        FramesHeaderBytes bytes = sampleHeader();
        bytes[bit / 8] ^= std::uint8_t(1 << bit % 8);
        EXPECT_THROW(parse(bytes), BundleError) << "bit " << bit;
    }
}

TEST(FramesHeader, NamesTheCrcItHasAndTheCrcItShouldHave) {
    FramesHeaderBytes bytes = sampleHeader();
    putNumber(bytes, 60, 4, 0x1234);
    const BundleError error = bundleErrorOf([&] { parse(bytes); });
    EXPECT_EQ(error.field(), "header CRC");
    EXPECT_EQ(error.found(), "0x00001234");
    EXPECT_EQ(error.expected(), hexWord(slowCrc(std::span(bytes).first(60))));
}

}  // namespace
}  // namespace facescan
