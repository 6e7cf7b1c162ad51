// Measures of joints.
#include "taut/check/private/function_table.h"
#include "taut/world/world.h"

namespace taut::check {

namespace {

Quantity jointsLeft(const Now& now, std::span<const Expression> arguments) {
    int left = 0;
    for (const world::JointInfo& joint : now.world().joints())
        if (arguments.empty() || joint.name == arguments[0].target) left += joint.left;
    return {glm::dvec3(left, 0, 0)};
}

}  // namespace

std::vector<Function> jointFunctions() {
    return {
        {"joints_left",
         {Takes::joint},
         true,
         false,
         "",
         "Number of points still tied by the joints of a name, or by all joints.",
         jointsLeft,
         {}},
    };
}

}  // namespace taut::check
