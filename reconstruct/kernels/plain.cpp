#include "reconstruct/kernels/lanes.h"
#include "reconstruct/kernels/table.h"

namespace facescan {

const Kernels& plainKernels() {
    static constexpr Kernels kTable = kernelsOf<OneLane>();
    return kTable;
}

}  // namespace facescan
