// Which vector instructions the kernels use: the best that the processor has, unless the user asks for less.
#pragma once

#include <string_view>

namespace taut::core {

enum class InstructionSet { sse2, avx2, avx512 };

std::string_view nameOf(InstructionSet set);  // "avx2", as TAUT_SIMD takes it

// Whether this processor has it.
bool isSupported(InstructionSet set);

// The set in use. At start the best supported one, at most avx2: wider vectors gain little and cost clock speed.
// The environment variable TAUT_SIMD (sse2, avx2, avx512) chooses another; one that is unknown or not supported
// throws Error(usage).
InstructionSet instructionSet();

// For tests and benchmarks; expects a supported set. Applies to kernels looked up afterwards.
void useInstructionSet(InstructionSet set);

}  // namespace taut::core
