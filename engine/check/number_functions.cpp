// The moment, and what is done with numbers.
#include <cmath>

#include "taut/check/function_table.h"

namespace taut::check {

namespace {

using Arguments = std::span<const Expression>;

Quantity number(double value) {
    return {glm::dvec3(value, 0, 0)};
}

}  // namespace

std::vector<Function> numberFunctions() {
    return {
        {"time",
         {},
         true,
         false,
         "s",
         "Since the start.",
         [](const Now& now, Arguments) { return number(now.world().time()); },
         nullptr},
        {"abs",
         {Takes::number},
         false,
         false,
         "",
         "A number without its sign.",
         [](const Now& now, Arguments a) { return number(std::abs(valueOf(a[0], now).x.x)); },
         nullptr},
        {"length",
         {Takes::vector},
         false,
         false,
         "",
         "Length of a vector.",
         [](const Now& now, Arguments a) {
             const glm::dvec3 x = valueOf(a[0], now).x;
             return number(std::sqrt(glm::dot(x, x)));
         },
         nullptr},
    };
}

}  // namespace taut::check
