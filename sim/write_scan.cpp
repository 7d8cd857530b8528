#include "sim/write_scan.h"

#include <cmath>

#include "capture/bundle.h"

namespace facescan::sim {

void writeScan(const SimulatedScan& scan, const std::filesystem::path& folder) {
    CaptureTiming timing;
    timing.frame_interval_ns =
        std::uint64_t(std::llround(scan.truth.device.frame_interval_s * 1e9));
    writeBundle(folder, scan.description, scan.frames.view(), timing);
}

}  // namespace facescan::sim
