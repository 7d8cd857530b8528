#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture/bundle_error.h"
#include "capture/byte_source.h"
#include "capture/frames_header.h"
#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"

// Sound pieces of bundles to be spoilt by tests, and what a test needs to look at the damage.

namespace facescan::test {

using Bytes = std::vector<std::uint8_t>;

/// A folder that lasts as long as its test.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// As long as it lives, root has no more rights than nobody.
class Unprivileged {
public:
    Unprivileged();
    ~Unprivileged();
    Unprivileged(const Unprivileged&) = delete;
    Unprivileged& operator=(const Unprivileged&) = delete;

private:
    bool was_root_;
};

void writeFile(const std::filesystem::path& path, std::string_view text);
void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
std::string readFile(const std::filesystem::path& path);

/// The names in a folder, hidden ones too, sorted.
std::vector<std::string> namesIn(const std::filesystem::path& folder);

/// CRC-32 of IEEE 802.3, bit by bit from its definition.
std::uint32_t slowCrc(std::span<const std::uint8_t> bytes);

/// A sound header, from the text of the format: 8 frames of 18 × 16 pixels, row stride 20, and the
/// CRC of samplePixels().
FramesHeaderBytes sampleHeader();
Bytes samplePixels();
Bytes sampleFramesFile();
Bytes framesFile(const FramesHeaderBytes& header, const Bytes& pixels);

void putNumber(std::span<std::uint8_t> bytes, std::size_t offset, std::size_t size,
               std::uint64_t value);
void renewHeaderCrc(std::span<std::uint8_t> header);

/// A sound document for sampleFramesFile(): 4 bits, degree 1.
std::string sampleXml();

/// sampleXml() with one part, which it must have, replaced.
std::string sampleXmlWith(std::string_view part, std::string_view replacement);

/// Writes a sound bundle and returns its folder.
std::filesystem::path writeSampleBundle(const TempFolder& folder);

/// What sampleXml() means.
ScanDescription sampleDescription();

/// A stack of frames of the given size; its pixels follow from `seed`.
FrameStack makeFrames(int count, int width, int height, int row_stride, unsigned seed = 1);

void expectSame(const ScanDescription& actual, const ScanDescription& expected);
void expectSame(const FrameStack& actual, const FrameStack& expected);

/// The BundleError that `action` throws; the test fails where it throws none.
template <typename Action>
BundleError bundleErrorOf(Action&& action) {
    try {
        action();
    } catch (const BundleError& error) {
        return error;
    }
    ADD_FAILURE() << "no BundleError was thrown";
    return {"", "", "", ""};
}

}  // namespace facescan::test
