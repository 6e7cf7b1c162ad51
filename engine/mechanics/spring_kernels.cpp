#include "mechanics/spring_kernels.h"

#include "core/instruction_set.h"

namespace taut::mechanics {

#define TAUT_DECLARE(isa)                            \
    namespace isa {                                  \
    void springRunFloat(const SpringRunArgs<float>&);    \
    void springRunDouble(const SpringRunArgs<double>&);  \
    void springListFloat(const SpringListArgs<float>&);  \
    void springListDouble(const SpringListArgs<double>&); \
    void scaleFloat(int, const float*, float*);      \
    void scaleDouble(int, const double*, double*);   \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

template <>
SpringKernels<float> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springRunFloat, avx512::springListFloat, avx512::scaleFloat};
        case core::InstructionSet::avx2: return {avx2::springRunFloat, avx2::springListFloat, avx2::scaleFloat};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springRunFloat, sse2::springListFloat, sse2::scaleFloat};
}

template <>
SpringKernels<double> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springRunDouble, avx512::springListDouble, avx512::scaleDouble};
        case core::InstructionSet::avx2: return {avx2::springRunDouble, avx2::springListDouble, avx2::scaleDouble};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springRunDouble, sse2::springListDouble, sse2::scaleDouble};
}

}  // namespace taut::mechanics
