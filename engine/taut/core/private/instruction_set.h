// Selects the vector instructions of the kernels: the fastest on this processor, unless the user chooses. Every set
// gives the same bits.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace taut::core {

// Instruction sets of the kernels (taut_kernels in engine/taut.cmake), from the narrowest on: each with its name and
// whether this processor supports it. Every processor supports the first.
#if defined(__wasm__)
#define TAUT_SETS(each, ...) each(wasm128, true, __VA_ARGS__)
#else
#define TAUT_SETS(each, ...)                                                                      \
    each(sse2, true, __VA_ARGS__) each(avx2, __builtin_cpu_supports("avx2") != 0, __VA_ARGS__)    \
        each(avx512,                                                                              \
             __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 && \
                 __builtin_cpu_supports("avx512dq") != 0,                                         \
             __VA_ARGS__)
#endif

#define TAUT_SET_NAME(set, condition, ...) set,
enum class InstructionSet { TAUT_SETS(TAUT_SET_NAME) };

std::string_view nameOf(InstructionSet set);  // "avx2", as TAUT_SIMD takes it

// Whether this processor has it.
bool isSupported(InstructionSet set);

// The set in use. When first asked for, the environment variable TAUT_SIMD (sse2, avx2, avx512, auto) says which; one
// that is unknown or not supported throws Error(usage). Else a trial of less than a millisecond does. Any thread may
// ask.
InstructionSet instructionSet();

// Declares kernels, each of which has a copy for each set.
#define TAUT_KERNELS(...) TAUT_SETS(TAUT_SET_KERNELS, __VA_ARGS__)
#define TAUT_SET_KERNELS(set, condition, ...) \
    namespace set {                           \
    __VA_ARGS__                               \
    }

// Of the copies of a kernel, that of the set in use.
#define TAUT_IN_USE(...) ::taut::core::inUse(::taut::core::instructionSet() TAUT_SETS(TAUT_SET_COPY, __VA_ARGS__))
#define TAUT_SET_COPY(set, condition, ...) , set::__VA_ARGS__
template <class Kernels, class... Wider>
Kernels inUse(InstructionSet set, Kernels narrowest, Wider... wider) {
    const Kernels copies[] = {narrowest, wider...};
    return copies[static_cast<std::size_t>(set)];
}

// How it was selected: "TAUT_SIMD", or the times of springs in the trial: "trial: sse2 2.1, avx2 1.0 ns".
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
