#include "taut/contact/closest_kernel.h"
#include "taut/core/private/instruction_set.h"

namespace taut::contact {

TAUT_KERNELS(extern const ClosestKernels closest;)

ClosestKernels closestKernels() {
    return TAUT_IN_USE(closest);
}

}  // namespace taut::contact
