#include "capture/bundle.h"

#include <fcntl.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "capture/bundle_error.h"
#include "capture/byte_source.h"
#include "capture/frames_file.h"
#include "capture/scan_xml.h"
#include "capture/staged_folder.h"
#include "capture/unique_fd.h"

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

ScanDocument readDocument(const fs::path& folder) {
    FileSource source(folder / kDocumentName);
    return readScanXml(source);
}

/// A bundle whose pixels are still to be read, from `frames`.
struct OpenBundle {
    explicit OpenBundle(const fs::path& folder)
        : scan(readDocument(folder)),
          frames(folder / scan.frames_file),
          header(readFramesHeader(frames)) {
        checkTogether(scan.description, header, (folder / kDocumentName).string());
    }

    BundleFingerprint fingerprint() const { return {scan.crc, framesHeaderCrc(header)}; }

    ScanDocument scan;
    FileSource frames;
    FramesHeader header;
};

}  // namespace

ScanBundle readBundle(const fs::path& folder) {
    ScanBundle bundle;
    readBundle(folder, bundle);
    return bundle;
}

void readBundle(const fs::path& folder, ScanBundle& bundle) {
    ScanBundle read;
    read.frames = std::exchange(bundle, {}).frames;

    OpenBundle open(folder);
    readFramePixels(open.frames, open.header, read.frames);

    read.description = std::move(open.scan.description);
    read.timing = open.header.timing;
    read.fingerprint = open.fingerprint();
    bundle = std::move(read);
}

BundleFingerprint readBundleFingerprint(const fs::path& folder) {
    return OpenBundle(folder).fingerprint();
}

void expectBundle(const fs::path& folder) {
    for (const char* name : {kDocumentName, kFramesFileName}) {
        const UniqueFd file(
            ::open((folder / name).c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
        if (file) ::posix_fadvise(file.get(), 0, 0, POSIX_FADV_WILLNEED);
    }
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
