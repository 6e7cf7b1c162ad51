// The slides' own differential equations, y' = f(t, y) with one unknown and a known solution.
#pragma once

#include <memory>
#include <string>

#include "taut/study/subject.h"

namespace taut::study {

struct FirstOrderProblem {
    std::string name, title;
    double start = 0;     // t at the start
    double y0 = 1;        // y there
    double duration = 1;  // until t = start + duration
    // f in both precisions; t is exact in double.
    float (*single)(double t, float y) = nullptr;
    double (*full)(double t, double y) = nullptr;
    double (*solution)(double t) = nullptr;
};

std::unique_ptr<Subject> makeFirstOrderSubject(const FirstOrderProblem& problem);

}  // namespace taut::study
