#include "taut/scene/method_names.h"

#include "taut/ode/method_table.h"

namespace taut::scene {

std::vector<std::string> methodNames() {
    std::vector<std::string> names;
    for (const ode::MethodInfo& method : ode::methods()) names.emplace_back(method.name);
    return names;
}

}  // namespace taut::scene
