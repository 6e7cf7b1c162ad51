#include "taut/mechanics/spring_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::mechanics {

#define TAUT_DECLARE(isa)                                     \
    namespace isa {                                           \
    void springBundleFloat(const SpringBundleArgs<float>&);   \
    void springBundleDouble(const SpringBundleArgs<double>&); \
    void springListFloat(const SpringListArgs<float>&);       \
    void springListDouble(const SpringListArgs<double>&);     \
    void packedListFloat(const PackedSpringArgs<float>&);     \
    void packedListDouble(const PackedSpringArgs<double>&);   \
    void packFloat(const PackArgs<float>&);                   \
    void packDouble(const PackArgs<double>&);                 \
    void unpackFloat(const UnpackArgs<float>&);               \
    void unpackDouble(const UnpackArgs<double>&);             \
    void accelerateFloat(const AccelerationArgs<float>&);     \
    void accelerateDouble(const AccelerationArgs<double>&);   \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

template <>
SpringKernels<float> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springBundleFloat, avx512::springListFloat, avx512::packedListFloat,
                    avx512::packFloat,         avx512::unpackFloat,     avx512::accelerateFloat};
        case core::InstructionSet::avx2:
            return {avx2::springBundleFloat, avx2::springListFloat, avx2::packedListFloat,
                    avx2::packFloat,         avx2::unpackFloat,     avx2::accelerateFloat};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springBundleFloat, sse2::springListFloat, sse2::packedListFloat,
            sse2::packFloat,         sse2::unpackFloat,     sse2::accelerateFloat};
}

template <>
SpringKernels<double> springKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::springBundleDouble, avx512::springListDouble, avx512::packedListDouble,
                    avx512::packDouble,         avx512::unpackDouble,     avx512::accelerateDouble};
        case core::InstructionSet::avx2:
            return {avx2::springBundleDouble, avx2::springListDouble, avx2::packedListDouble,
                    avx2::packDouble,         avx2::unpackDouble,     avx2::accelerateDouble};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::springBundleDouble, sse2::springListDouble, sse2::packedListDouble,
            sse2::packDouble,         sse2::unpackDouble,     sse2::accelerateDouble};
}

}  // namespace taut::mechanics
