#include "taut/render/private/edge_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

TAUT_KERNELS(extern const EdgeKernels edges;)

EdgeKernels edgeKernels() {
    return core::inUse(sse2::edges, avx2::edges, avx512::edges);
}

}  // namespace taut::render
