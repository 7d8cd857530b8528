#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels& portableKernels() {
    static constexpr Kernels kTable = kernelsOf<VectorLanes>();
    return kTable;
}

const Kernels& kernels() {
#ifdef __ARM_NEON
    return *neonKernels();
#else
    return portableKernels();
#endif
}

}  // namespace facescan
