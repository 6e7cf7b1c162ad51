#include "taut/ode/private/update_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::ode {

#define TAUT_DECLARE(isa)                                                                                             \
    namespace isa {                                                                                                   \
    bool leapfrogFloat(int, const float*, const float*, const float*, float, float, float*, float*, float*);          \
    bool leapfrogDouble(int, const double*, const double*, const double*, double, double, double*, double*, double*); \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

template <>
UpdateKernels<float> updateKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512: return {avx512::leapfrogFloat};
        case core::InstructionSet::avx2: return {avx2::leapfrogFloat};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::leapfrogFloat};
}

template <>
UpdateKernels<double> updateKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512: return {avx512::leapfrogDouble};
        case core::InstructionSet::avx2: return {avx2::leapfrogDouble};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::leapfrogDouble};
}

}  // namespace taut::ode
