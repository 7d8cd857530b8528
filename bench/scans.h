#pragma once

#include <filesystem>

#include "capture/bundle.h"

// The scans that benchmarks work on. Each is made when it is first asked for, and kept.

namespace facescan::bench {

/// A face as the device records it: 480 × 768 pixels, 8 bits. The realistic case.
const ScanBundle& faceScan();
std::filesystem::path faceScanFolder();

/// The same drawn surface twice: 480 × 768 pixels with 8 bits, and 2240 × 3584 with 10, as many
/// pixels a stripe. Their times a pixel and frame show how the cost grows.
const ScanBundle& smallScan();
const ScanBundle& largeScan();

}  // namespace facescan::bench
