// A vector or number that changes linearly with time, either between two times or without an end: the place of a hand,
// the velocity of a wind, a pressure.
#pragma once

#include <glm/glm.hpp>

namespace taut::mechanics {

template <class Value>
struct LinearPathOf {
    Value from{0.0}, to{0.0};
    double t0 = 0.0, t1 = 0.0;  // [s]
    bool isLine = false;        // continues beyond both ends instead of resting there

    // `at` at t0, and everywhere else on the line through it.
    static LinearPathOf line(const Value& at, const Value& rate, double t0) {
        return {at, at + rate, t0, t0 + 1.0, true};
    }

    // Linear from a to b between the times; constant if a and b are the same.
    static LinearPathOf between(const Value& a, const Value& b, double t0, double t1) {
        return a == b ? LinearPathOf{a, a} : LinearPathOf{a, b, t0, t1};
    }

    // `from` before t0, `to` from t1 on, unless it is a line.
    Value at(double t) const {
        if (isLine) return from + (to - from) * (t - t0);
        if (t >= t1) return to;
        if (t <= t0) return from;
        return from + (to - from) * ((t - t0) / (t1 - t0));
    }

    // Its rate of change: zero outside t0 <= t < t1, unless it is a line [1/s].
    Value rate(double t) const {
        if (isLine) return to - from;
        return t >= t0 && t < t1 ? (to - from) / (t1 - t0) : Value(0.0);
    }
};

using LinearPath = LinearPathOf<glm::dvec3>;

}  // namespace taut::mechanics
