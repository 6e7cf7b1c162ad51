// Gusts: a smooth random velocity field, a pure function of time, place and seed. It knows no force.
//
// Six waves cross the field. Directions, lengths and phases come from hashes of the seed. Each wave runs one gust
// length per period. Its strength is a vector that wanders in time between hashed values, so that nothing repeats. The
// field averages to zero and stays below its amplitude everywhere. It is smooth, except that it is twice continuously
// differentiable in t where the strengths turn, and three times in x where a wave begins its next turn. A step of
// length h across such a join is off by O(h⁴) in v at most, once for each join. So methods up to order 4 keep their
// order.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "taut/mechanics/private/wind_kernel.h"

namespace taut::mechanics {

struct GustField {
    double amplitude = 0.0;  // [m/s] never exceeded; typical speeds are about half of it
    double period = 1.5;     // [s] > 0, time in which a gust comes and goes
    double length = 2.0;     // [m] > 0 size of an eddy, half a wave on average
    std::int64_t seed = 1;
    bool operator==(const GustField&) const = default;
};

// The field's waves at one instant, in the form the wind kernel takes.
template <class Real>
GustWaves<Real> gustWaves(const GustField& field, double t);

// [m/s] The velocity at a place and time. The kernel computes the same in batches, up to rounding.
glm::dvec3 gustVelocity(const GustField& field, double t, const glm::dvec3& x);

extern template GustWaves<float> gustWaves<float>(const GustField&, double);
extern template GustWaves<double> gustWaves<double>(const GustField&, double);

}  // namespace taut::mechanics
