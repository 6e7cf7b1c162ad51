#include "taut/render/private/depth_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

TAUT_KERNELS(extern const DepthKernels depths;)

DepthKernels depthKernels() {
    return core::inUse(sse2::depths, avx2::depths, avx512::depths);
}

}  // namespace taut::render
