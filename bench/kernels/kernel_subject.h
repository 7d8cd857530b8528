#pragma once

#include <functional>
#include <span>

#include "bench/kernels/kernel_rows.h"

namespace facescan::bench {

/// Calls one kernel of the form that it is given, again and again on the same rows.
using KernelCall = std::function<void(const Kernels&)>;

/// Pixels or cells of a row in a scan.
inline constexpr int kRowLength = 480;

struct KernelSubject {
    const char* name;  ///< in Kernels
    int items;         ///< that a call goes through, pixels, cells or edges: the rows' length
    KernelCall (*prepare)(KernelRows& rows);
};

// Every kernel, by what it works on.
std::span<const KernelSubject> pixelKernels();
std::span<const KernelSubject> edgeKernels();
std::span<const KernelSubject> pointKernels();
std::span<const KernelSubject> motionKernels();
std::span<const KernelSubject> windowKernels();
std::span<const KernelSubject> quadKernels();

}  // namespace facescan::bench
