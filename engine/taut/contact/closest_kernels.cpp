// The kernels of the instruction set in use.
#include "taut/contact/closest_kernel.h"
#include "taut/contact/flatness_kernel.h"
#include "taut/core/private/instruction_set.h"

namespace taut::contact {

#define TAUT_DECLARE(isa)                                                             \
    namespace isa {                                                                   \
    void onTriangles(ClosestLanes&, int);                                             \
    void onSegments(ClosestLanes&, int);                                              \
    bool findOverlapping(const BoxLanes&, const float*, const float*, std::uint64_t*); \
    int findDue(CandidateRows&);                                                      \
    void findGradients(const EdgeRows&, double*, int);                                \
    void findLeast(const GradientRows&, const double*, const double*, double*);       \
    void findMost(const GradientRows&, double*);                                      \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

ClosestKernels closestKernels() {
    return core::inUse<ClosestKernels>({sse2::onTriangles, sse2::onSegments, sse2::findOverlapping, sse2::findDue},
                                       {avx2::onTriangles, avx2::onSegments, avx2::findOverlapping, avx2::findDue},
                                       {avx512::onTriangles, avx512::onSegments, avx512::findOverlapping,
                                        avx512::findDue});
}

FlatnessKernels flatnessKernels() {
    return core::inUse<FlatnessKernels>({sse2::findGradients, sse2::findLeast, sse2::findMost},
                                        {avx2::findGradients, avx2::findLeast, avx2::findMost},
                                        {avx512::findGradients, avx512::findLeast, avx512::findMost});
}

}  // namespace taut::contact
