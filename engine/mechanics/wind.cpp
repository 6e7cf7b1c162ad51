#include "mechanics/wind.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/instruction_set.h"

namespace taut::mechanics {
namespace {

template <class Real>
auto windKernel() -> void (*)(const WindBatch<Real>&) {
    switch (core::instructionSet()) {
        case core::InstructionSet::avx512:
            return avx512::addWind;
        case core::InstructionSet::avx2:
            return avx2::addWind;
        case core::InstructionSet::sse2:
            break;
    }
    return sse2::addWind;
}

}  // namespace

template <class Real>
Wind<Real>::Wind(std::span<const Triangle> triangles, const glm::dvec3& velocity, const WindSettings& settings)
    : triangles_(triangles.begin(), triangles.end()),
      runs_(triangles),
      weight_(runs_.sources().size()),
      velocity_{velocity, velocity, 0.0, 0.0},
      settings_(settings),
      addBatch_(windKernel<Real>()) {
    for (std::size_t lane = 0; lane < weight_.size(); ++lane)
        weight_[lane] = runs_.sources()[lane] >= 0 ? Real(1) : Real(0);
}

template <class Real>
glm::dvec3 Wind<Real>::airVelocity(const glm::dvec3& x, double t) const {
    const glm::dvec3 steady = velocity_.at(t);
    return settings_.gust.amplitude > 0.0 ? steady + gustVelocity(settings_.gust, t, x) : steady;
}

template <class Real>
double Wind<Real>::workingSpeed() const {
    if (settings_.workingSpeed > 0.0) return settings_.workingSpeed;
    const double steady = std::max(glm::length(velocity_.from), glm::length(velocity_.to));
    return std::max(10.0, 2.0 * (steady + settings_.gust.amplitude));
}

template <class Real>
void Wind<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    GustWaves<Real> gust;
    WindBatch<Real> batch{};
    batch.lanes = runs_.lanes();
    batch.weight = weight_.data();
    batch.stride = motion.stride;
    batch.x = motion.x;
    batch.v = motion.v;
    batch.f = f;
    const glm::dvec3 flow = velocity_.at(motion.t);
    for (int axis = 0; axis < 3; ++axis) batch.flow[axis] = static_cast<Real>(flow[axis]);
    batch.drag = static_cast<Real>(settings_.airDensity * settings_.drag / 12.0);
    batch.lift = static_cast<Real>(settings_.airDensity * settings_.lift / 12.0);
    if (settings_.gust.amplitude > 0.0) {
        gust = gustWaves<Real>(settings_.gust, motion.t);
        batch.gust = &gust;
    }
    addBatch_(batch);
}

template <class Real>
void Wind<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    const double speed = workingSpeed();
    const double slope = 2.0 * std::abs(settings_.drag) + 1.5 * std::abs(settings_.lift);
    auto at = [&](int i) {
        const std::ptrdiff_t stride = motion.stride;
        return glm::dvec3(motion.x[i], motion.x[i + stride], motion.x[i + 2 * stride]);
    };
    for (const auto& [a, b, c] : triangles_) {
        const double area = 0.5 * glm::length(glm::cross(at(b) - at(a), at(c) - at(a)));
        const double damping = 0.5 * settings_.airDensity * area * speed * slope / 3.0;  // [kg/s] of each corner
        for (int i : {a, b, c})
            share.dampingRate[static_cast<std::size_t>(i)] += damping * static_cast<double>(motion.inverseMass[i]);
    }
}

template class Wind<float>;
template class Wind<double>;

}  // namespace taut::mechanics
