#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels* neonKernels() {
#ifdef FACESCAN_HAS_NEON
    static constexpr Kernels kTable = kernelsOf<NeonLanes>();
    return &kTable;
#else
    return nullptr;
#endif
}

}  // namespace facescan
