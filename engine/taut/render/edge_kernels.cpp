#include "taut/render/private/edge_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

#define TAUT_DECLARE(isa)                                                                          \
    namespace isa {                                                                                \
    void cover(const CoverageArgs&);                                                               \
    void findEdges(const std::uint32_t* const[3], const float* const[3], int, int, std::uint8_t*); \
    void fillUndrawn(std::size_t, std::uint32_t, const std::uint32_t*, std::uint32_t*);            \
    void fillNearer(std::size_t, const std::uint32_t*, const float*, std::uint32_t*, float*);      \
    void takeColours(std::size_t, const std::uint32_t*, std::uint8_t*);                            \
    constexpr EdgeKernels kernels{cover, findEdges, fillUndrawn, fillNearer, takeColours};         \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

EdgeKernels edgeKernels() {
    return core::inUse(sse2::kernels, avx2::kernels, avx512::kernels);
}

}  // namespace taut::render
