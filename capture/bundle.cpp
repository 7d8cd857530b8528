#include "capture/bundle.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "capture/bundle_error.h"
#include "capture/byte_source.h"
#include "capture/frames_file.h"
#include "capture/scan_xml.h"
#include "capture/staged_folder.h"

namespace facescan {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDocumentName = "scan.xml";

std::string size(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

/// The rules that concern both files.
void checkTogether(const ScanDescription& scan, const FramesHeader& frames,
                   const std::string& document) {
    const Rect& image = scan.image;
    if (image.x + image.width > frames.width || image.y + image.height > frames.height)
        throw BundleError(document, "image",
                          size(image.width, image.height) + " at (" + std::to_string(image.x) +
                              ", " + std::to_string(image.y) + ")",
                          "a part of the " + size(frames.width, frames.height) + " frame");
    const int end = scan.first_frame + scan.pattern.frameCount();
    if (end > frames.frame_count)
        throw BundleError(
            document, "frames first + count", std::to_string(end),
            "at most " + std::to_string(frames.frame_count) + ", the number of frames in the file");
}

std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

ScanBundle readBundle(const fs::path& folder) {
    ScanBundle bundle;
    readBundle(folder, bundle);
    return bundle;
}

void readBundle(const fs::path& folder, ScanBundle& bundle) {
    ScanBundle read;
    read.frames = std::exchange(bundle, {}).frames;

    FileSource document(folder / kDocumentName);
    ScanDocument scan = readScanXml(document);
    FileSource frames(folder / scan.frames_file);
    const FramesHeader header = readFramesHeader(frames);
    checkTogether(scan.description, header, document.name());
    readFramePixels(frames, header, read.frames);

    read.description = std::move(scan.description);
    read.timing = header.timing;
    bundle = std::move(read);
}

void writeBundle(const fs::path& folder, const ScanDescription& description,
                 const FrameStackView& frames, const CaptureTiming& timing) {
    FramesHeader header{.frame_count = frames.count,
                        .width = frames.width,
                        .height = frames.height,
                        .row_stride = frames.row_stride,
                        .timing = timing,
                        .pixel_crc = 0};
    const std::string document = formatScanXml(description);

    // The reader is the judge of what is to be written.
    const std::string document_path = (folder / kDocumentName).string();
    parseFramesHeader(encodeFramesHeader(header), (folder / kFramesFileName).string());
    parseScanXml(document, document_path);
    checkTogether(description, header, document_path);

    const std::span pixels(frames.pixels, std::size_t(header.pixelBytes()));
    header.pixel_crc = pixelCrc(pixels);
    StagedFolder staged(folder);
    staged.writeFile(kFramesFileName, {encodeFramesHeader(header), pixels});
    staged.writeFile(kDocumentName, {bytesOf(document)});
    staged.commit();
}

}  // namespace facescan
