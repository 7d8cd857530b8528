#include "bench/scans.h"

#include "bench/analytic_scan.h"

namespace facescan::bench {

std::filesystem::path faceScanFolder() {
    return std::filesystem::path(TEST_DATA_DIR) / "face_still";
}

const ScanBundle& faceScan() {
    static const ScanBundle scan = readBundle(faceScanFolder());
    return scan;
}

const ScanBundle& smallScan() {
    static const ScanBundle scan = analyticScan(480, 768, 8);
    return scan;
}

const ScanBundle& largeScan() {
    static const ScanBundle scan = analyticScan(2240, 3584, 10);
    return scan;
}

}  // namespace facescan::bench
