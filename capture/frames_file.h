#pragma once

#include <cstdint>
#include <span>

#include "capture/byte_source.h"
#include "capture/frames_header.h"
#include "reconstruct/frame_stack.h"

// frames.bin of the scan bundle: a header, then the pixels.

namespace facescan {

/// Reads the header, and checks it and the size of the file: afterwards `source` is known to hold
/// header.pixelBytes() more bytes. @throws BundleError
FramesHeader readFramesHeader(ByteSource& source);

/// Reads the pixels behind `header` and checks their CRC.
/// @param frames  overwritten; nothing is allocated where it held as many bytes before. When an
///                error is thrown it is left empty.
/// @throws BundleError
void readFramePixels(ByteSource& source, const FramesHeader& header, FrameStack& frames);

/// The CRC-32 of the pixels, as the header carries it.
std::uint32_t pixelCrc(std::span<const std::uint8_t> pixels);

}  // namespace facescan
