// The machine that a run used, for its record. It is never used in a calculation.
#pragma once

#include <string>

namespace taut::pipeline {

struct Machine {
    std::string program;     // "taut 0.1.0"
    std::string compiler;    // "g++ 12.2.0, Release"
    std::string processor;   // model name
    std::string system;      // "Linux 6.1.0"
    std::string simd;        // instruction set of the kernels in use
    std::string simdReason;  // why these
    int threads = 1;         // of the machine
    double memory = 0.0;     // [bytes] of the machine
};

Machine machine();

}  // namespace taut::pipeline
