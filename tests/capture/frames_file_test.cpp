#include "capture/frames_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <limits>

#include "capture/samples.h"

namespace facescan {
namespace {

using namespace test;

FrameStack readAll(std::span<const std::uint8_t> file) {
    MemorySource source("frames.bin", file);
    FrameStack frames;
    const FramesHeader header = readFramesHeader(source);
    readFramePixels(source, header, frames);
    return frames;
}

TEST(FramesFile, YieldsThePixelsFrameAfterFrame) {
    expectSame(readAll(sampleFramesFile()), makeFrames(8, 18, 16, 20));
}

TEST(FramesFile, IsReadAcrossManyChunks) {
    const FrameStack frames = makeFrames(3, 400, 500, 411);
    const FramesHeader header{.frame_count = 3,
                              .width = 400,
                              .height = 500,
                              .row_stride = 411,
                              .timing = {},
                              .pixel_crc = slowCrc(frames.pixels)};
    expectSame(readAll(framesFile(encodeFramesHeader(header), frames.pixels)), frames);
}

TEST(FramesFile, CutAnywhereIsRefused) {
    const Bytes file = sampleFramesFile();
    for (std::size_t size = 0; size < file.size(); ++size) {
        const BundleError error = bundleErrorOf([&] { readAll(std::span(file).first(size)); });
        EXPECT_EQ(error.field(), "file size") << size;
        EXPECT_EQ(error.found(), std::to_string(size) + " bytes");
    }
}

TEST(FramesFile, WithBytesBehindThePixelsIsRefused) {
    Bytes file = sampleFramesFile();
    file.push_back(0);
    const BundleError error = bundleErrorOf([&] { readAll(file); });
    EXPECT_STREQ(error.what(),
                 "frames.bin: file size is 2625 bytes, expected 2624 bytes (64 + 8 frames x 16 "
                 "rows x 20 bytes)");
}

TEST(FramesFile, WithOnePixelChangedIsRefused) {
    const std::size_t size = sampleFramesFile().size();
    for (const std::size_t place : {std::size_t(64), size / 2, size - 1}) {
        Bytes file = sampleFramesFile();
        file[place] ^= 1;
        const BundleError error = bundleErrorOf([&] { readAll(file); });
        EXPECT_EQ(error.field(), "pixel CRC");
        EXPECT_EQ(error.found(), hexWord(slowCrc(samplePixels())));
        EXPECT_EQ(error.expected(),
                  hexWord(slowCrc(std::span(file).subspan(64))) + ", the CRC of the pixels");
    }
}

TEST(FramesFile, UsesTheMemoryOfTheStackBefore) {
    const Bytes file = sampleFramesFile();
    FrameStack frames = makeFrames(8, 16, 16, 20, 7);
    const std::uint8_t* const memory = frames.pixels.data();
    MemorySource source("frames.bin", file);
    const FramesHeader header = readFramesHeader(source);
    readFramePixels(source, header, frames);
    EXPECT_EQ(frames.pixels.data(), memory);
    expectSame(frames, makeFrames(8, 18, 16, 20));
}

TEST(FramesFile, LeavesTheStackEmptyOnError) {
    Bytes file = sampleFramesFile();
    file.back() ^= 1;
    FrameStack frames = makeFrames(8, 18, 16, 20);
    MemorySource source("frames.bin", file);
    const FramesHeader header = readFramesHeader(source);
    EXPECT_THROW(readFramePixels(source, header, frames), BundleError);
    expectSame(frames, FrameStack{});
}

/// A file that only says how large it is.
class HugeSource : public ByteSource {
public:
    HugeSource() : ByteSource("frames.bin") {}
    std::uint64_t size() const override { return 64 + (std::uint64_t(1) << 37); }
    void read(std::span<std::uint8_t>) override { std::abort(); }
};

TEST(FramesFile, LargerThanTheMemoryIsRefused) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the address sanitizer needs the address space itself";
#endif
    const auto read = [] {
        const rlimit limit{.rlim_cur = 1 << 30, .rlim_max = 1 << 30};
        ::setrlimit(RLIMIT_AS, &limit);
        HugeSource source;
        FrameStack frames;
        const FramesHeader header{.frame_count = 1024,
                                  .width = 8192,
                                  .height = 8192,
                                  .row_stride = 16384,
                                  .timing = {},
                                  .pixel_crc = 0};
        try {
            readFramePixels(source, header, frames);
        } catch (const BundleError& error) {
            std::fputs(error.what(), stderr);
            std::exit(0);
        }
    };
    EXPECT_EXIT(read(), testing::ExitedWithCode(0),
                "file size is 137438953472 bytes of pixels, expected a size that fits");
}

TEST(PixelCrc, IsThatOfZlib) {
    const std::string_view text = "123456789";
    EXPECT_EQ(pixelCrc({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}),
              0xcbf43926);  // the check value of CRC-32/ISO-HDLC
}

}  // namespace
}  // namespace facescan
