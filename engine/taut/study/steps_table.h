// The slides' tables for their two equations: the steps that each method needs, and the effect of equal work.
#pragma once

#include <string>
#include <vector>

#include "taut/study/subject.h"

namespace taut::study {

struct StepsRow {
    std::string method;
    double tolerance = 0;  // of |y - exact| at the end
    long long steps = 0;   // smallest number of equal steps that stays below it
    long long evaluations = 0;
    double error = 0;         // with that number
    int stepsForFour = 0;     // with which it makes four evaluations of y' in all
    double errorForFour = 0;  // |y - exact| then
};

// Rows for those of the methods (empty: all) that integrate a first-order subject, in the order of the method table, in
// double precision, from its start to 1 further. Expects one that knows its solution.
std::vector<StepsRow> stepsTable(const Subject& subject, double tolerance = 1e-6,
                                 const std::vector<std::string>& methods = {});

// |y - exact| of a method after n equal steps to 1 further.
double endError(const Subject& subject, const std::string& method, long long steps);

}  // namespace taut::study
