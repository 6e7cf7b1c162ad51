#include "taut/contact/closest_points.h"

#include "taut/contact/closest_text.h"

namespace taut::contact {

using namespace TAUT_ISA;  // of closest_text.h

Closest closestPoints(const Corners& corners, bool isPoint) {
    const auto at = [&](std::size_t k) { return Place{corners[k].x, corners[k].y, corners[k].z}; };
    const Place p = at(0), q = at(1), r = at(2), s = at(3);
    const ClosestWeights weights = isPoint ? onTriangle(p, q, r, s) : onSegment(p, q, r, s);
    const Place sum = sumOf(weights, p, q, r, s);
    return {{weights.of[0], weights.of[1], weights.of[2], weights.of[3]}, {sum.x, sum.y, sum.z}, weights.where};
}

}  // namespace taut::contact
