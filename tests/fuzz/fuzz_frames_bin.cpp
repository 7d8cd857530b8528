#include <algorithm>
#include <span>
#include <vector>

#include "capture/bundle_error.h"
#include "capture/frames_file.h"
#include "fuzz/fuzz_target.h"

namespace facescan {
namespace {

using fuzz::require;
using Bytes = std::vector<std::uint8_t>;

/// Whatever is accepted is, written again, the same bytes.
void checkAccepted(const FramesHeader& header, const FrameStack& frames, const Bytes& file) {
    const FramesHeaderBytes bytes = encodeFramesHeader(header);
    require(std::equal(bytes.begin(), bytes.end(), file.begin()), "the header is the same");
    require(std::equal(frames.pixels.begin(), frames.pixels.end(), file.begin() + bytes.size(),
                       file.end()),
            "the pixels are the same");
    require(frames.pixels.size() == frames.view().frameBytes() * std::size_t(frames.count),
            "there are as many pixels as the stack says");
}

void read(const Bytes& file) {
    MemorySource source("frames.bin", file);
    FrameStack frames;
    try {
        const FramesHeader header = readFramesHeader(source);
        readFramePixels(source, header, frames);
        checkAccepted(header, frames, file);
    } catch (const BundleError&) {
        require(frames.pixels.empty() && frames.count == 0, "no half of a scan");
    }
}

void put(Bytes& file, std::size_t offset, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) file[offset + i] = std::uint8_t(value >> (8 * i));
}

/// With both CRCs put right, so that the fuzzer comes past them.
void renewCrcs(Bytes& file) {
    put(file, 48, pixelCrc(std::span(file).subspan(kFramesHeaderBytes)));
    put(file, 60, pixelCrc(std::span(file).first(60)));
}

}  // namespace
}  // namespace facescan

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    facescan::Bytes file(data, data + size);
    facescan::read(file);
    if (size < facescan::kFramesHeaderBytes) return 0;
    facescan::renewCrcs(file);
    facescan::read(file);
    return 0;
}
