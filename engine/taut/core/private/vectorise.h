// Promises to the compiler for the loops of the kernels. Macros only: kernels are compiled once an instruction set
// and must share no inline function with the rest.
#pragma once

// The iterations of the next loop are independent: the arrays that it writes overlap no others that it touches.
#if defined(__clang__)
#define TAUT_INDEPENDENT _Pragma("clang loop vectorize(assume_safety) interleave(disable)")
#else
#define TAUT_INDEPENDENT _Pragma("GCC ivdep")
#endif
