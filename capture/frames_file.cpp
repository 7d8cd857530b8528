#include "capture/frames_file.h"

#include <libdeflate.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "capture/bundle_error.h"

namespace facescan {
namespace {

// Small enough that a chunk is still in the cache when its CRC is taken, large enough that system
// calls do not count: measured from 16 KiB to 8 MiB.
constexpr std::size_t kChunkBytes = 256 * 1024;

void resizePixels(std::vector<std::uint8_t>& pixels, std::uint64_t size, const std::string& file) {
    constexpr std::uint64_t kMost = std::numeric_limits<std::size_t>::max();
    try {
        pixels.resize(std::size_t(std::min(size, kMost)));
    } catch (const std::exception&) {
        throw BundleError(file, "file size", std::to_string(size) + " bytes of pixels",
                          "a size that fits in this machine's memory");
    }
}

}  // namespace

FramesHeader readFramesHeader(ByteSource& source) {
    const std::string found = std::to_string(source.size()) + " bytes";
    if (source.size() < kFramesHeaderBytes)
        throw BundleError(source.name(), "file size", found, "a header of 64 bytes and the pixels");
    FramesHeaderBytes bytes;
    source.read(bytes);
    const FramesHeader header = parseFramesHeader(bytes, source.name());
    const std::uint64_t size = kFramesHeaderBytes + header.pixelBytes();
    if (source.size() != size)
        throw BundleError(source.name(), "file size", found,
                          std::to_string(size) + " bytes (64 + " +
                              std::to_string(header.frame_count) + " frames x " +
                              std::to_string(header.height) + " rows x " +
                              std::to_string(header.row_stride) + " bytes)");
    return header;
}

void readFramePixels(ByteSource& source, const FramesHeader& header, FrameStack& frames) {
    std::vector<std::uint8_t> pixels = std::exchange(frames, {}).pixels;
    resizePixels(pixels, header.pixelBytes(), source.name());

    std::uint32_t crc = 0;
    for (std::span<std::uint8_t> rest = pixels; !rest.empty();) {
        const std::span<std::uint8_t> chunk = rest.first(std::min(rest.size(), kChunkBytes));
        source.read(chunk);
        crc = libdeflate_crc32(crc, chunk.data(), chunk.size());
        rest = rest.subspan(chunk.size());
    }
    if (crc != header.pixel_crc)
        throw BundleError(source.name(), "pixel CRC", hexWord(header.pixel_crc),
                          hexWord(crc) + ", the CRC of the pixels");
    frames = {std::move(pixels), header.frame_count, header.width, header.height,
              header.row_stride};
}

std::uint32_t pixelCrc(std::span<const std::uint8_t> pixels) {
    return libdeflate_crc32(0, pixels.data(), pixels.size());
}

}  // namespace facescan
