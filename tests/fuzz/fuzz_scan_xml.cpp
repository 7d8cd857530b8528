#include <string>

#include "capture/bundle_error.h"
#include "capture/scan_xml.h"
#include "fuzz/fuzz_target.h"

namespace facescan {
namespace {

using fuzz::require;

/// Whatever is accepted keeps the rules, and is the same when it was written and read again.
void checkAccepted(const ScanDocument& scan) {
    const std::string text = formatScanXml(scan.description);
    const ScanDocument again = parseScanXml(text, "scan.xml");
    require(formatScanXml(again.description) == text, "a description survives the file");
    require(scan.frames_file.find('/') == std::string::npos, "the frames are in the folder");
    const Calibration& calibration = scan.description.calibration;
    for (const std::vector<double>& output : calibration.coefficients)
        require(int(output.size()) == polynomialTerms(calibration.degree), "all terms are there");
}

}  // namespace
}  // namespace facescan

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    facescan::MemorySource source("scan.xml", {data, size});
    try {
        facescan::checkAccepted(facescan::readScanXml(source));
    } catch (const facescan::BundleError& error) {
        facescan::fuzz::require(std::string(error.what()).find('\n') == std::string::npos,
                                "an error is one line");
    }
    return 0;
}
