#include "taut/render/private/edge_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

TAUT_KERNELS(extern const EdgeKernels edges;)

EdgeKernels edgeKernels() {
    return TAUT_IN_USE(edges);
}

}  // namespace taut::render
