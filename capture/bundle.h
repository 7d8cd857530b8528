#pragma once

#include <cstdint>
#include <filesystem>

#include "capture/frames_header.h"
#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"

namespace facescan {

/// Tells bundles apart without their pixels: two CRC-32, of scan.xml and of the header of the
/// frames' file, which holds the CRC of the pixels.
struct BundleFingerprint {
    std::uint32_t document_crc = 0;
    std::uint32_t frames_header_crc = 0;

    friend bool operator==(const BundleFingerprint&, const BundleFingerprint&) = default;
};

/// A scan as it is stored: a folder with scan.xml and frames.bin.
struct ScanBundle {
    ScanDescription description;
    FrameStack frames;  ///< all of the file's, also those outside of the description's
    CaptureTiming timing;
    BundleFingerprint fingerprint;
};

/// Reads a bundle and checks every rule of its format. Memory is taken for what the files hold.
/// @param folder  of the bundle
/// @throws BundleError at the first broken rule, or a file that cannot be read
ScanBundle readBundle(const std::filesystem::path& folder);

/// The same, into a bundle whose memory is used again: frames of the same size as before need no
/// new one. When an error is thrown, `bundle` is left empty.
void readBundle(const std::filesystem::path& folder, ScanBundle& bundle);

/// The fingerprint of a bundle whose pixels nobody reads. @throws BundleError where a rule is
/// broken that concerns anything else
BundleFingerprint readBundleFingerprint(const std::filesystem::path& folder);

/// Tells the system that a bundle will soon be read, so that its disk works ahead. Nothing is read
/// into this process, and nothing is said about what cannot be read.
void expectBundle(const std::filesystem::path& folder);

/// Writes a bundle: the whole folder appears under its name, on disk, or none.
/// @param folder  does not exist yet, or is empty; its parent exists
/// @param frames  at least those that the description speaks of
/// @throws BundleError where the reader would refuse what is to be written
/// @throws std::system_error where it cannot be written: "<path>: cannot write: <reason>"
void writeBundle(const std::filesystem::path& folder, const ScanDescription& description,
                 const FrameStackView& frames, const CaptureTiming& timing = {});

}  // namespace facescan
