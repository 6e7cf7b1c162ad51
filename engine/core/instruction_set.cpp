#include "taut/core/instruction_set.h"

#include <atomic>
#include <cstdlib>
#include <string>

#include "taut/core/error.h"

namespace taut::core {
namespace {

InstructionSet chosenAtStart() {
    if (const char* wish = std::getenv("TAUT_SIMD"); wish != nullptr && *wish != '\0') {
        for (InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512})
            if (nameOf(set) == wish) {
                if (isSupported(set)) return set;
                throw Error(ErrorKind::usage, "TAUT_SIMD=" + std::string(wish) + ": this processor does not have it");
            }
        throw Error(ErrorKind::usage, "TAUT_SIMD=" + std::string(wish) + ": expected sse2, avx2 or avx512");
    }
    return isSupported(InstructionSet::avx2) ? InstructionSet::avx2 : InstructionSet::sse2;
}

std::atomic<InstructionSet>& current() {
    static std::atomic<InstructionSet> set = chosenAtStart();
    return set;
}

}  // namespace

std::string_view nameOf(InstructionSet set) {
    switch (set) {
        case InstructionSet::sse2: return "sse2";
        case InstructionSet::avx2: return "avx2";
        case InstructionSet::avx512: return "avx512";
    }
    return "?";
}

bool isSupported(InstructionSet set) {
    switch (set) {
        case InstructionSet::sse2: return true;
        case InstructionSet::avx2: return __builtin_cpu_supports("avx2") != 0;
        case InstructionSet::avx512:
            return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
                   __builtin_cpu_supports("avx512dq") != 0;
    }
    return false;
}

InstructionSet instructionSet() {
    return current();
}

void useInstructionSet(InstructionSet set) {
    TAUT_EXPECTS(isSupported(set));
    current() = set;
}

}  // namespace taut::core
