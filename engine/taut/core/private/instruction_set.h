// Which vector instructions the kernels use: those that are fastest on this processor, unless the user says which.
// Every set gives the same bits.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace taut::core {

enum class InstructionSet { sse2, avx2, avx512 };

std::string_view nameOf(InstructionSet set);  // "avx2", as TAUT_SIMD takes it

// Whether this processor has it.
bool isSupported(InstructionSet set);

// The set in use. When first asked for, the environment variable TAUT_SIMD (sse2, avx2, avx512, auto) says which; one
// that is unknown or not supported throws Error(usage). Else a trial of less than a millisecond does. Any thread may
// ask.
InstructionSet instructionSet();

// Declares kernels, each of which has a copy for each set (taut_kernel in engine/taut.cmake).
#define TAUT_KERNELS(...) \
    namespace sse2 {      \
    __VA_ARGS__           \
    }                     \
    namespace avx2 {      \
    __VA_ARGS__           \
    }                     \
    namespace avx512 {    \
    __VA_ARGS__           \
    }

// Of the copies of a kernel, that of the set in use.
template <class Kernels>
Kernels inUse(Kernels sse2, Kernels avx2, Kernels avx512) {
    switch (instructionSet()) {
        case InstructionSet::avx512: return avx512;
        case InstructionSet::avx2: return avx2;
        case InstructionSet::sse2: break;
    }
    return sse2;
}

// How that was decided: "TAUT_SIMD", "--isa", or what springs took in the trial: "trial: sse2 2.1, avx2 1.0 ns".
std::string instructionSetReason();

// Takes a set as TAUT_SIMD has it, for `reason`; "auto" tries which is fastest. Applies to kernels looked up
// afterwards. Throws Error(usage), naming the reason, on one that is unknown or not supported.
void chooseInstructionSet(std::string_view name, const std::string& reason);

// For tests and benchmarks; expects a supported set. Applies to kernels looked up afterwards.
void useInstructionSet(InstructionSet set);

struct InstructionSetTime {
    InstructionSet set;
    double nanoseconds;  // a spring, of single and of double precision in the mean
};
std::string textOf(std::span<const InstructionSetTime> times);
// The one to use of those given from the narrowest on, at least one: a wider one has to gain a twentieth, for it may
// cost clock speed.
InstructionSet fastestOf(std::span<const InstructionSetTime> times);

}  // namespace taut::core
