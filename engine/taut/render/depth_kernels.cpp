#include "taut/render/private/depth_kernels.h"

#include "taut/core/private/instruction_set.h"

namespace taut::render {

#define TAUT_DECLARE(isa)                                                            \
    namespace isa {                                                                  \
    void drawTriangles(const MapTriangle*, int, int, int, int, std::uint16_t*);      \
    void findBounds(const std::uint16_t*, int, int, std::uint16_t*, std::uint16_t*); \
    void addHidden(const SkyRing (&)[skyRings], int, float*);                        \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

DepthKernels depthKernels() {
    return core::inUse<DepthKernels>({sse2::drawTriangles, sse2::findBounds, sse2::addHidden},
                                     {avx2::drawTriangles, avx2::findBounds, avx2::addHidden},
                                     {avx512::drawTriangles, avx512::findBounds, avx512::addHidden});
}

}  // namespace taut::render
