// The integration methods that a scene may name: those of the table in ode.
#pragma once

#include <string>
#include <vector>

namespace taut::scene {

// In the order of ode's table.
std::vector<std::string> methodNames();

}  // namespace taut::scene
