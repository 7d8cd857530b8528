#include "capture/frames_header.h"

#include <libdeflate.h>

#include <algorithm>
#include <string_view>

#include "capture/bundle_error.h"

namespace facescan {
namespace {

constexpr std::string_view kMagic = "FSCANBIN";
constexpr std::uint16_t kVersion = 1;
constexpr std::uint32_t kGrey = 0x59455247;  // V4L2_PIX_FMT_GREY

enum Offset : std::size_t {
    kAtMagic = 0,
    kAtVersion = 8,
    kAtHeaderSize = 10,
    kAtPixelFormat = 12,
    kAtFrameCount = 16,
    kAtWidth = 20,
    kAtHeight = 24,
    kAtRowStride = 28,
    kAtStartTime = 32,
    kAtFrameInterval = 40,
    kAtPixelCrc = 48,
    kAtReserved = 52,
    kAtHeaderCrc = 60,
};

template <typename Unsigned>
Unsigned littleEndian(const FramesHeaderBytes& bytes, std::size_t offset) {
    Unsigned value = 0;
    for (std::size_t i = sizeof(Unsigned); i-- > 0;)
        value = Unsigned(value << 8 | bytes[offset + i]);
    return value;
}

template <typename Unsigned>
void putLittleEndian(FramesHeaderBytes& bytes, std::size_t offset, Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
        bytes[offset + i] = std::uint8_t(std::uint64_t(value) >> (8 * i));
}

std::string_view textAt(const FramesHeaderBytes& bytes, std::size_t offset, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes.data()) + offset, size};
}

std::uint32_t headerCrc(const FramesHeaderBytes& bytes) {
    return libdeflate_crc32(0, bytes.data(), kAtHeaderCrc);
}

/// One header and the file it stands in: what a check needs.
struct HeaderReader {
    const FramesHeaderBytes& bytes;
    const std::string& file;

    void require(bool rule, const char* field, const std::string& found,
                 const std::string& expected) const {
        if (!rule) throw BundleError(file, field, found, expected);
    }

    void same(const char* field, std::uint32_t found, std::uint32_t expected) const {
        require(found == expected, field, std::to_string(found), std::to_string(expected));
    }

    void sameHex(const char* field, std::uint32_t found, std::uint32_t expected) const {
        require(found == expected, field, hexWord(found), hexWord(expected));
    }

    int inRange(const char* field, std::size_t offset, int min, int max) const {
        const auto value = littleEndian<std::uint32_t>(bytes, offset);
        require(value >= std::uint32_t(min) && value <= std::uint32_t(max), field,
                std::to_string(value), std::to_string(min) + " to " + std::to_string(max));
        return int(value);
    }
};

}  // namespace

FramesHeader parseFramesHeader(const FramesHeaderBytes& bytes, const std::string& file) {
    const HeaderReader reader{bytes, file};
    const std::string_view magic = textAt(bytes, kAtMagic, kMagic.size());
    reader.require(magic == kMagic, "magic", inQuotes(magic), inQuotes(kMagic));
    reader.same("version", littleEndian<std::uint16_t>(bytes, kAtVersion), kVersion);
    reader.same("header size", littleEndian<std::uint16_t>(bytes, kAtHeaderSize),
                kFramesHeaderBytes);
    reader.sameHex("pixel format", littleEndian<std::uint32_t>(bytes, kAtPixelFormat), kGrey);

    FramesHeader header;
    header.frame_count = reader.inRange("frame count", kAtFrameCount, 1, kMaxFrames);
    header.width = reader.inRange("width", kAtWidth, kMinSide, kMaxSide);
    header.height = reader.inRange("height", kAtHeight, kMinSide, kMaxSide);
    header.row_stride = reader.inRange("row stride", kAtRowStride, header.width, kMaxRowStride);
    header.timing.start_time_ns = littleEndian<std::uint64_t>(bytes, kAtStartTime);
    header.timing.frame_interval_ns = littleEndian<std::uint64_t>(bytes, kAtFrameInterval);
    header.pixel_crc = littleEndian<std::uint32_t>(bytes, kAtPixelCrc);

    const std::string_view reserved = textAt(bytes, kAtReserved, kAtHeaderCrc - kAtReserved);
    reader.require(littleEndian<std::uint64_t>(bytes, kAtReserved) == 0, "reserved",
                   inQuotes(reserved), "8 bytes of zero");
    reader.sameHex("header CRC", littleEndian<std::uint32_t>(bytes, kAtHeaderCrc),
                   headerCrc(bytes));
    return header;
}

FramesHeaderBytes encodeFramesHeader(const FramesHeader& header) {
    FramesHeaderBytes bytes{};
    std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
    putLittleEndian(bytes, kAtVersion, kVersion);
    putLittleEndian(bytes, kAtHeaderSize, std::uint16_t(kFramesHeaderBytes));
    putLittleEndian(bytes, kAtPixelFormat, kGrey);
    putLittleEndian(bytes, kAtFrameCount, std::uint32_t(header.frame_count));
    putLittleEndian(bytes, kAtWidth, std::uint32_t(header.width));
    putLittleEndian(bytes, kAtHeight, std::uint32_t(header.height));
    putLittleEndian(bytes, kAtRowStride, std::uint32_t(header.row_stride));
    putLittleEndian(bytes, kAtStartTime, header.timing.start_time_ns);
    putLittleEndian(bytes, kAtFrameInterval, header.timing.frame_interval_ns);
    putLittleEndian(bytes, kAtPixelCrc, header.pixel_crc);
    putLittleEndian(bytes, kAtHeaderCrc, headerCrc(bytes));
    return bytes;
}

std::uint32_t framesHeaderCrc(const FramesHeader& header) {
    return headerCrc(encodeFramesHeader(header));
}

}  // namespace facescan
