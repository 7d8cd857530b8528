#pragma once

#include <filesystem>

#include "capture/frames_header.h"
#include "reconstruct/frame_stack.h"
#include "reconstruct/scan.h"

namespace facescan {

/// A scan as it is stored: a folder with scan.xml and frames.bin.
struct ScanBundle {
    ScanDescription description;
    FrameStack frames;  ///< all of the file's, also those outside of the description's
    CaptureTiming timing;
};

/// Reads a bundle and checks every rule of its format. Memory is taken for what the files hold.
/// @param folder  of the bundle
/// @throws BundleError at the first broken rule, or a file that cannot be read
ScanBundle readBundle(const std::filesystem::path& folder);

/// The same, into a bundle whose memory is used again: frames of the same size as before need no
/// new one. When an error is thrown, `bundle` is left empty.
void readBundle(const std::filesystem::path& folder, ScanBundle& bundle);

/// Writes a bundle: the whole folder appears under its name, on disk, or none.
/// @param folder  does not exist yet, or is empty; its parent exists
/// @param frames  at least those that the description speaks of
/// @throws BundleError where the reader would refuse what is to be written
/// @throws std::system_error where it cannot be written: "<path>: cannot write: <reason>"
void writeBundle(const std::filesystem::path& folder, const ScanDescription& description,
                 const FrameStackView& frames, const CaptureTiming& timing = {});

}  // namespace facescan
