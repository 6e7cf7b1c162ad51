#include "taut/collision/private/contact_kernel.h"
#include "taut/core/private/instruction_set.h"

namespace taut::collision {

#define TAUT_DECLARE(isa)                                          \
    namespace isa {                                                \
    long contactFloat(const ContactArgs<float>&, ContactLanes&);   \
    long contactDouble(const ContactArgs<double>&, ContactLanes&); \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

template <>
ContactKernel<float> contactKernel() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512: return avx512::contactFloat;
        case core::InstructionSet::avx2: return avx2::contactFloat;
        case core::InstructionSet::sse2: break;
    }
    return sse2::contactFloat;
}

template <>
ContactKernel<double> contactKernel() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512: return avx512::contactDouble;
        case core::InstructionSet::avx2: return avx2::contactDouble;
        case core::InstructionSet::sse2: break;
    }
    return sse2::contactDouble;
}

}  // namespace taut::collision
