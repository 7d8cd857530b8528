#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

// The 64-byte header of the scan bundle's frames.bin.

namespace facescan {

inline constexpr int kMaxFrames = 1024;
inline constexpr int kMinSide = 16;  ///< px, of a frame and of the part that is reconstructed
inline constexpr int kMaxSide = 8192;
inline constexpr int kMaxRowStride = 16384;

/// When the frames of a scan were taken.
struct CaptureTiming {
    std::uint64_t start_time_ns = 0;      ///< since the Unix epoch, UTC; 0: unknown
    std::uint64_t frame_interval_ns = 0;  ///< 0: unknown

    friend bool operator==(const CaptureTiming&, const CaptureTiming&) = default;
};

/// The header's values, in the order of the file.
struct FramesHeader {
    int frame_count = 0;
    int width = 0;       ///< px
    int height = 0;      ///< px
    int row_stride = 0;  ///< bytes, at least `width`
    CaptureTiming timing;
    std::uint32_t pixel_crc = 0;

    std::uint64_t pixelBytes() const {
        return std::uint64_t(frame_count) * std::uint64_t(height) * std::uint64_t(row_stride);
    }
};

inline constexpr std::size_t kFramesHeaderBytes = 64;
using FramesHeaderBytes = std::array<std::uint8_t, kFramesHeaderBytes>;

/// Checks every field of a header, in the order of the file.
/// @param file  the file's path, for messages
/// @throws BundleError at the first broken rule
FramesHeader parseFramesHeader(const FramesHeaderBytes& bytes, const std::string& file);

/// The inverse of parseFramesHeader(). Checks nothing.
FramesHeaderBytes encodeFramesHeader(const FramesHeader& header);

/// The CRC-32 of a header, as it carries it in its last four bytes.
std::uint32_t framesHeaderCrc(const FramesHeader& header);

}  // namespace facescan
