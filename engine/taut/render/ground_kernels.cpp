#include "taut/render/private/ground_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

TAUT_KERNELS(extern const GroundKernels grounds;)

GroundKernels groundKernels() {
    return TAUT_IN_USE(grounds);
}

}  // namespace taut::render
