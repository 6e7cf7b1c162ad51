#include "taut/contact/closest_kernel.h"
#include "taut/contact/flatness_kernel.h"
#include "taut/core/private/instruction_set.h"

namespace taut::contact {

TAUT_KERNELS(extern const ClosestKernels closest; extern const FlatnessKernels flatness;)

ClosestKernels closestKernels() {
    return TAUT_IN_USE(closest);
}

FlatnessKernels flatnessKernels() {
    return TAUT_IN_USE(flatness);
}

}  // namespace taut::contact
