// The slides' table for y' = y: how many steps each method needs, and what equal work buys.
#pragma once

#include <string>
#include <vector>

namespace taut::study {

struct GrowthRow {
    std::string method;
    double tolerance = 0;  // of |y(1) - e|
    long long steps = 0;   // smallest number of equal steps from 0 to 1 that stays below it
    long long evaluations = 0;
    double error = 0;         // with that number
    int stepsForFour = 0;     // with which it makes four evaluations of y' in all
    double errorForFour = 0;  // |y(1) - e| then
};

// Rows for those of the methods (empty: all) that integrate y' = y, in the order of the method table, in double
// precision.
std::vector<GrowthRow> growthTable(double tolerance = 1e-6, const std::vector<std::string>& methods = {});

// |y(1) - e| of a method after n equal steps from y(0) = 1.
double growthError(const std::string& method, long long steps);

}  // namespace taut::study
