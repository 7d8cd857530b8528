#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels& plainKernels() {
    static constexpr Kernels table = kernelsOf<OneLane>();
    return table;
}

}  // namespace facescan
