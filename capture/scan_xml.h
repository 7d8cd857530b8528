#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "capture/byte_source.h"
#include "reconstruct/scan.h"

// scan.xml of the scan bundle.

namespace facescan {

/// The name of the frames' file in the bundles that we write.
inline constexpr const char* kFramesFileName = "frames.bin";

/// A longer document is refused unread. A usual one has 5 KB.
inline constexpr std::size_t kMaxScanXmlBytes = 1 << 20;

/// What a document says.
struct ScanDocument {
    ScanDescription description;
    std::string frames_file;  ///< a plain name in the document's folder
    std::uint32_t crc = 0;    ///< CRC-32 of its text
};

/// Checks every rule that concerns the document alone. @throws BundleError at a broken one
/// @param file  the document's path, for messages
ScanDocument parseScanXml(std::string_view document, const std::string& file);

/// The same, from a file. @throws BundleError
ScanDocument readScanXml(ByteSource& source);

/// The document of a scan whose frames are in kFramesFileName. Its numbers are the shortest that
/// parseScanXml() reads as the same values. Checks nothing.
std::string formatScanXml(const ScanDescription& description);

}  // namespace facescan
