// A vector that moves evenly from one value to another between two times: where a hand leads, how a wind rises.
#pragma once

#include <glm/glm.hpp>

namespace taut::mechanics {

struct LinearPath {
    glm::dvec3 from{0.0}, to{0.0};
    double t0 = 0.0, t1 = 0.0;  // [s]

    // `from` before t0, `to` from t1 on.
    glm::dvec3 at(double t) const {
        if (t >= t1) return to;
        if (t <= t0) return from;
        return from + (to - from) * ((t - t0) / (t1 - t0));
    }

    // Its rate of change: zero outside t0 <= t < t1 [1/s].
    glm::dvec3 rate(double t) const { return t >= t0 && t < t1 ? (to - from) / (t1 - t0) : glm::dvec3(0.0); }
};

}  // namespace taut::mechanics
