#include "taut/contact/nearest_kernel.h"
#include "taut/core/instruction_set.h"

namespace taut::contact {

#define TAUT_DECLARE(isa)                                                                \
    namespace isa {                                                                      \
    void onTriangles(NearestLanes&, int);                                                \
    void onSegments(NearestLanes&, int);                                                 \
    void overlaps(const BoxLanes&, const double (&)[3], const double (&)[3], long* hit); \
    int findAwake(NearPairRows&);                                                        \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

NearestKernels nearestKernels() {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return {avx512::onTriangles, avx512::onSegments, avx512::overlaps, avx512::findAwake};
        case core::InstructionSet::avx2: return {avx2::onTriangles, avx2::onSegments, avx2::overlaps, avx2::findAwake};
        case core::InstructionSet::sse2: break;
    }
    return {sse2::onTriangles, sse2::onSegments, sse2::overlaps, sse2::findAwake};
}

}  // namespace taut::contact
