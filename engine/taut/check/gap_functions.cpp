// Measures between bodies.
#include "taut/check/private/function_table.h"
#include "taut/world/private/body_surfaces.h"

namespace taut::check {

namespace {

using Arguments = std::span<const Expression>;

Quantity gap(const Now& now, Arguments a) {
    return {glm::dvec3(now.gap(a[0].target, a[1].target).gap(), 0, 0)};
}
Quantity touching(const Now& now, Arguments a) {
    return {glm::dvec3(now.gap(a[0].target, a[1].target).areNear() ? 1 : 0, 0, 0)};
}

}  // namespace

std::vector<Function> gapFunctions() {
    const std::vector<Takes> two{Takes::bodies, Takes::bodies};
    return {
        {"gap",
         two,
         false,
         false,
         "m",
         "Smallest distance of the surfaces of two bodies, with any `touch`; 0 if they cross.",
         gap,
         {}},
        {"touching",
         two,
         false,
         false,
         "",
         "1 if two bodies are within 105 % of the sum of their thicknesses, else 0.",
         touching,
         {},
         world::Counts::touchingBodies},
    };
}

}  // namespace taut::check
