#include "taut/render/private/depth_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

TAUT_KERNELS(extern const DepthKernels depths;)

DepthKernels depthKernels() {
    return TAUT_IN_USE(depths);
}

}  // namespace taut::render
