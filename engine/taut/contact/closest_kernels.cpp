#include "taut/contact/closest_kernel.h"
#include "taut/contact/flatness_kernel.h"
#include "taut/core/private/instruction_set.h"

namespace taut::contact {

TAUT_KERNELS(extern const ClosestKernels closest; extern const FlatnessKernels flatness;)

ClosestKernels closestKernels() {
    return core::inUse(sse2::closest, avx2::closest, avx512::closest);
}

FlatnessKernels flatnessKernels() {
    return core::inUse(sse2::flatness, avx2::flatness, avx512::flatness);
}

}  // namespace taut::contact
