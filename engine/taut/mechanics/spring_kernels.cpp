#include "taut/mechanics/spring_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> SpringKernels<Real> springKernels();)

template <class Real>
SpringKernels<Real> springKernels() {
    return TAUT_IN_USE(springKernels<Real>)();
}
template SpringKernels<float> springKernels();
template SpringKernels<double> springKernels();

}  // namespace taut::mechanics
