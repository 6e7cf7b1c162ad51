#include "taut/mechanics/spring_kernels.h"

#include "taut/core/instruction_set.h"

namespace taut::mechanics {

#define TAUT_DECLARE(isa)                                   \
    namespace isa {                                         \
    void springRunFloat(const SpringRunArgs<float>&);       \
    void springRunDouble(const SpringRunArgs<double>&);     \
    void springListFloat(const SpringListArgs<float>&);     \
    void springListDouble(const SpringListArgs<double>&);   \
    void accelerateFloat(const AccelerationArgs<float>&);   \
    void accelerateDouble(const AccelerationArgs<double>&); \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

template <>
SpringKernels<float> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springRunFloat, avx512::springListFloat, avx512::accelerateFloat};
        case core::InstructionSet::avx2: return {avx2::springRunFloat, avx2::springListFloat, avx2::accelerateFloat};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springRunFloat, sse2::springListFloat, sse2::accelerateFloat};
}

template <>
SpringKernels<double> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springRunDouble, avx512::springListDouble, avx512::accelerateDouble};
        case core::InstructionSet::avx2: return {avx2::springRunDouble, avx2::springListDouble, avx2::accelerateDouble};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springRunDouble, sse2::springListDouble, sse2::accelerateDouble};
}

}  // namespace taut::mechanics
