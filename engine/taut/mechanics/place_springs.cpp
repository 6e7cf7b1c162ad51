#include "taut/mechanics/private/place_springs.h"

#include <algorithm>
#include <cmath>

namespace taut::mechanics {
namespace {

using glm::dmat3;
using glm::dvec3;

template <class Real>
dvec3 sumOver(const PlaceSpring& spring, int stride, const Real* planes) {
    dvec3 sum(0.0);
    for (const auto& [point, weight] : spring.shares)
        for (int axis = 0; axis < 3; ++axis)
            sum[axis] += weight * static_cast<double>(planes[static_cast<std::ptrdiff_t>(axis) * stride + point]);
    return sum;
}

template <class Real>
void spread(const PlaceSpring& spring, const dvec3& value, int stride, Real* planes) {
    for (const auto& [point, weight] : spring.shares)
        for (int axis = 0; axis < 3; ++axis)
            planes[static_cast<std::ptrdiff_t>(axis) * stride + point] += static_cast<Real>(weight * value[axis]);
}

// The way from its second end to its first, and how it changes.
struct Way {
    dvec3 d, rate;     // [m], [m/s]
    double length;     // [m]
    dvec3 along{0.0};  // unit, if both ends are apart
};

template <class Real>
Way wayOf(const PlaceSpring& spring, const Motion<Real>& motion) {
    PlaceSpring::Place second;
    if (spring.second) second = spring.second(motion.t);
    Way way{sumOver(spring, motion.stride, motion.x) - second.x, sumOver(spring, motion.stride, motion.v) - second.v,
            0.0};
    way.length = std::sqrt(glm::dot(way.d, way.d));
    if (way.length > 0) way.along = way.d / way.length;
    return way;
}

// -∂F/∂d without the dashpot. isWhole: with a negative part.
dmat3 slopeOf(const PlaceSpring& spring, const Way& way, bool isWhole) {
    if (spring.length == 0.0) return dmat3(spring.stiffness);
    const dmat3 along = glm::outerProduct(way.along, way.along);
    if (!(way.length > 0)) return dmat3(0.0);
    const double across = 1.0 - spring.length / way.length;
    return spring.stiffness * (along + (isWhole ? across : std::max(0.0, across)) * (dmat3(1.0) - along));
}

}  // namespace

template <class Real>
void PlaceSprings<Real>::addForces(const Motion<Real>& motion, int /*first*/, int /*last*/, Real* f) const {
    for (const PlaceSpring& spring : springs_) {
        const Way way = wayOf(spring, motion);
        const double k = spring.stiffness, c = spring.damping;
        const dvec3 pull = spring.length == 0.0
                               ? k * way.d + c * way.rate
                               : (k * (way.length - spring.length) + c * glm::dot(way.rate, way.along)) * way.along;
        spread(spring, -pull, motion.stride, f);
    }
}

template <class Real>
double PlaceSprings<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    double energy = 0;
    for (const PlaceSpring& spring : springs_) {
        const auto counts = [&](const auto& share) {
            return only.empty() || only[static_cast<std::size_t>(share.point)];
        };
        if (!std::all_of(spring.shares.begin(), spring.shares.end(), counts)) continue;
        const double stretch = wayOf(spring, motion).length - spring.length;
        energy += 0.5 * spring.stiffness * stretch * stretch;
    }
    return energy;
}

template <class Real>
void PlaceSprings<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    for (const PlaceSpring& spring : springs_)
        spread(spring, slopeOf(spring, wayOf(spring, motion), true) * sumOver(spring, motion.stride, u), motion.stride,
               out);
}

template <class Real>
void PlaceSprings<Real>::linearise(const Motion<Real>& motion, double stiffness, double damping) {
    slopes_.clear();
    for (const PlaceSpring& spring : springs_) {
        const Way way = wayOf(spring, motion);
        const dmat3 damped = spring.length == 0.0 ? dmat3(1.0) : glm::outerProduct(way.along, way.along);
        slopes_.push_back(stiffness * slopeOf(spring, way, false) + (damping * spring.damping) * damped);
    }
}

template <class Real>
void PlaceSprings<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (std::size_t s = 0; s < slopes_.size(); ++s)
        spread(springs_[s], slopes_[s] * sumOver(springs_[s], stride, u), stride, out);
}

template <class Real>
void PlaceSprings<Real>::addDiagonal(int stride, Real* out) const {
    for (std::size_t s = 0; s < slopes_.size(); ++s)
        for (const auto& [point, weight] : springs_[s].shares)
            for (int axis = 0; axis < 3; ++axis)
                out[static_cast<std::ptrdiff_t>(axis) * stride + point] +=
                    static_cast<Real>(weight * weight * slopes_[s][axis][axis]);
}

template <class Real>
void PlaceSprings<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    for (const PlaceSpring& spring : springs_) {
        double sum = 0;
        for (const auto& own : spring.shares) sum += std::abs(own.weight);
        for (const auto& [point, weight] : spring.shares) {
            const auto i = static_cast<std::size_t>(point);
            const double row = std::abs(weight) * sum;
            share.stiffness[i] += row * spring.stiffness;
            share.dampingRate[i] += row * spring.damping * static_cast<double>(motion.inverseMass[i]);
        }
    }
}

template class PlaceSprings<float>;
template class PlaceSprings<double>;

}  // namespace taut::mechanics
