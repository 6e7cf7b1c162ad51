#include "taut/contact/nearest_kernel.h"
#include "taut/core/instruction_set.h"

namespace taut::contact {

#define TAUT_DECLARE(isa)                                                     \
    namespace isa {                                                           \
    void onTriangles(NearestLanes&, int);                                     \
    void onSegments(NearestLanes&, int);                                      \
    int findOverlapping(const BoxLanes&, const double*, const double*, int*); \
    int findAwake(NearPairRows&);                                             \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

NearestKernels nearestKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::onTriangles, avx512::onSegments, avx512::findOverlapping, avx512::findAwake};
        case core::InstructionSet::avx2:
            return {avx2::onTriangles, avx2::onSegments, avx2::findOverlapping, avx2::findAwake};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::onTriangles, sse2::onSegments, sse2::findOverlapping, sse2::findAwake};
}

}  // namespace taut::contact
