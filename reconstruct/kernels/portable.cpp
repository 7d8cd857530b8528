#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels& portableKernels() {
    static constexpr Kernels table = kernelsOf<VectorLanes>();
    return table;
}

const Kernels& kernels() {
    static const Kernels& chosen =
        neonKernels() && sizeof(void*) == 4 ? *neonKernels() : portableKernels();
    return chosen;
}

}  // namespace facescan
