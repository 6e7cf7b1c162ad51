// The time, and functions of numbers.
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/check/private/function_table.h"
#include "taut/world/world.h"

namespace taut::check {

namespace {

using Arguments = std::span<const Expression>;

Quantity time(const Now& now, Arguments) {
    return {glm::dvec3(now.world().time(), 0, 0)};
}
Quantity absolute(const Now& now, Arguments a) {
    return {glm::dvec3(std::abs(valueOf(a[0], now).x.x), 0, 0)};
}
Quantity length(const Now& now, Arguments a) {
    const glm::dvec3 x = valueOf(a[0], now).x;
    return {glm::dvec3(std::sqrt(glm::dot(x, x)), 0, 0)};
}

}  // namespace

std::vector<Function> numberFunctions() {
    return {
        {"time", {}, true, false, "s", "Time since the start.", time, {}},
        {"abs", {Takes::number}, false, false, "", "Absolute value of a number.", absolute, {}},
        {"length", {Takes::vector}, false, false, "", "Length of a vector.", length, {}},
    };
}

}  // namespace taut::check
