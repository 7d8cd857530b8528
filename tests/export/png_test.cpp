#include "export/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "export/peer.h"
#include "export/scratch_folder.h"

namespace facescan::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Pixels without order, so that none can stand for another.
std::vector<std::uint8_t> noise(std::size_t count) {
    std::vector<std::uint8_t> bytes(count);
    std::uint32_t state = 1;
    for (std::uint8_t& byte : bytes) {
        state = state * 1664525u + 1013904223u;
        byte = std::uint8_t(state >> 24);
    }
    return bytes;
}

GreyImage noiseImage(int width, int height) {
    return {width, height, noise(std::size_t(width) * height)};
}

std::string pngOf(const ImageView& image) {
    std::string png;
    formatPng(image, png);
    return png;
}

template <typename Step>
std::string errorOf(Step step) {
    try {
        step();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

class PngOfAnySize : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(PngOfAnySize, GivesStbTheSameGreyPixels) {
    const auto [width, height] = GetParam();
    const GreyImage image = noiseImage(width, height);
    int channels = 0;
    const GreyImage peer = decodeByStb(pngOf(view(image)), &channels);
    EXPECT_EQ(channels, 1);
    EXPECT_EQ(peer.width, width);
    EXPECT_EQ(peer.height, height);
    EXPECT_EQ(peer.pixels, image.pixels);
}

INSTANTIATE_TEST_SUITE_P(Png, PngOfAnySize,
                         testing::Values(std::pair(1, 1), std::pair(1, 50), std::pair(50, 1),
                                         std::pair(17, 31), std::pair(480, 754)));

TEST(Png, GivesStbTheSameColours) {
    for (const int channels : {3, 4}) {
        const std::vector<std::uint8_t> pixels = noise(std::size_t(20) * 10 * channels);
        int in_file = 0;
        const GreyImage peer = decodeByStb(pngOf({pixels.data(), 20, 10, channels}), &in_file);
        EXPECT_EQ(in_file, channels);
        EXPECT_EQ(peer.pixels, pixels);
    }
}

TEST(Png, HasTheSameBytesEveryTimeAndNothingButTheImage) {
    const GreyImage image = noiseImage(64, 48);
    const std::string png = pngOf(view(image));
    EXPECT_EQ(png, pngOf(view(image)));
    for (const char* chunk : {"tIME", "tEXt", "gAMA", "pHYs"})
        EXPECT_THAT(png, Not(HasSubstr(chunk)));
}

TEST(PngEncoder, MakesTheSameFileWhateverItMadeBefore) {
    const GreyImage image = noiseImage(64, 48);
    const GreyImage larger = noiseImage(100, 80);
    PngEncoder encoder;
    std::string png;
    encoder.format(view(larger), png);
    encoder.format(view(image), png);
    EXPECT_EQ(png, pngOf(view(image)));
}

TEST(Png, IsReadByLibpngToo) {
    const GreyImage image = noiseImage(33, 21);
    EXPECT_EQ(parseGreyPng(pngOf(view(image))).pixels, image.pixels);
}

TEST(Png, RefusesAnEmptyImageAndAnUnknownPixel) {
    const GreyImage image = noiseImage(4, 4);
    EXPECT_THAT(errorOf([] { pngOf({nullptr, 0, 0, 1}); }), HasSubstr("the image is empty"));
    EXPECT_THAT(errorOf([&] {
                    pngOf({image.pixels.data(), 2, 4, 2});
                }),
                HasSubstr("2 channels; 1, 3 or 4 expected"));
}

TEST(Png, NamesTheFileThatCannotBeWritten) {
    const ScratchFolder folder;
    EXPECT_THAT(errorOf([&] {
                    writePng(folder / "preview.png", {nullptr, 0, 0, 1});
                }),
                HasSubstr("/preview.png: PNG: the image is empty"));
    EXPECT_TRUE(folder.names().empty());
}

TEST(ParseGreyPng, ReadsThePixelsOfAnotherWriter) {
    const GreyImage image = noiseImage(33, 21);
    const GreyImage read = parseGreyPng(encodeByStb(image));
    EXPECT_EQ(read.width, 33);
    EXPECT_EQ(read.height, 21);
    EXPECT_EQ(read.pixels, image.pixels);
}

TEST(ParseGreyPng, RejectsColour) {
    const std::string colour = encodeByStb(noiseImage(30, 5), 3);
    EXPECT_THAT(errorOf([&] { parseGreyPng(colour); }), HasSubstr("8-bit grey pixels expected"));
}

TEST(ParseGreyPng, RejectsAFileCutShortAnywhere) {
    const std::string png = encodeByStb(noiseImage(16, 16));
    // The last twelve bytes are the end mark, which no pixel needs.
    for (std::size_t size = 0; size < png.size() - 12; ++size) {
        EXPECT_NE(errorOf([&] { parseGreyPng(png.substr(0, size)); }), "") << size;
    }
}

/// A PNG without pixels: the signature, an IHDR that claims a size, an empty IDAT, IEND.
std::string pixellessPng(const std::string& size_and_crc) {
    using namespace std::string_literals;
    return "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR"s + size_and_crc + "\0\0\0\0IDAT\x35\xaf\x06\x1e"s +
           "\0\0\0\0IEND\xae\x42\x60\x82"s;
}

TEST(ParseGreyPng, TakesNoMemoryOnTheWordOfAHeader) {
    using namespace std::string_literals;
    const std::string large = "\0\0\x1f\x40\0\0\x1f\x40\x08\0\0\0\0\x23\x9a\xf2\x28"s;
    EXPECT_THAT(errorOf([&] { parseGreyPng(pixellessPng(large)); }),
                HasSubstr("too short for 8000 × 8000 pixels"));
    const std::string huge = "\0\x03\x0d\x40\0\x03\x0d\x40\x08\0\0\0\0\xdc\x50\xd7\xd6"s;
    EXPECT_THAT(errorOf([&] { parseGreyPng(pixellessPng(huge)); }),
                HasSubstr("200000 × 200000 pixels; at most 8192 × 8192 expected"));
}

}  // namespace
}  // namespace facescan::test
