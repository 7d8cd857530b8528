#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels* neonKernels() {
#ifdef FACESCAN_HAS_NEON
    static constexpr Kernels table = kernelsOf<NeonLanes>();
    return &table;
#else
    return nullptr;
#endif
}

}  // namespace facescan
