// Where a value is found, in words. Looked up only when somebody is to read it.
#pragma once

#include <functional>
#include <string>

#include "taut/check/private/evaluation.h"

namespace taut::check {

// The point of a target that has the largest measure: "cloth.flag@#12 at [0.1, 2.0, 0.3]".
std::string extremePoint(const Now& now, const std::string& target,
                         const std::function<double(const world::PointsNow&, std::size_t)>& measure);

// The body with the largest measure of a target; empty target: of all bodies.
std::string extremeBody(const Now& now, const std::string& bodies, world::Measures what,
                        const std::function<double(const world::Metrics&)>& measure);

}  // namespace taut::check
