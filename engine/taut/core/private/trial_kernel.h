// A piece of work for each instruction set, to be timed.
#pragma once

namespace taut::core {

// x and f are three planes of trialPoints + trialReach numbers; each point pulls at trialOffsets others.
inline constexpr int trialPoints = 512, trialReach = 64, trialOffsets = 4;

#define TAUT_DECLARE(isa)                     \
    namespace isa {                           \
    void trialFloat(const float*, float*);    \
    void trialDouble(const double*, double*); \
    }
TAUT_DECLARE(sse2)
TAUT_DECLARE(avx2)
TAUT_DECLARE(avx512)
#undef TAUT_DECLARE

}  // namespace taut::core
