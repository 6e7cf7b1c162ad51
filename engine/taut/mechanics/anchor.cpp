#include "taut/mechanics/private/anchor.h"

#include <algorithm>
#include <numeric>

#include "taut/core/error.h"

namespace taut::mechanics {

template <class Real>
Anchor<Real>::Anchor(std::vector<int> points, const glm::dvec3& place, double stiffness, double damping,
                     std::vector<glm::dvec3> offsets)
    : Anchor(points, place, std::vector<double>(points.size(), stiffness), std::vector<double>(points.size(), damping),
             std::move(offsets)) {}

template <class Real>
Anchor<Real>::Anchor(std::vector<int> points, const glm::dvec3& place, std::vector<double> stiffness,
                     std::vector<double> damping, std::vector<glm::dvec3> offsets)
    : path_(LinearPath{place, place, 0.0, 0.0}) {
    TAUT_EXPECTS(stiffness.size() == points.size() && damping.size() == points.size());
    TAUT_EXPECTS(offsets.empty() || offsets.size() == points.size());
    offsets.resize(points.size(), glm::dvec3(0.0));
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    for (std::size_t i : order) {
        TAUT_EXPECTS(points_.empty() || points_.back() != points[i]);
        TAUT_EXPECTS(stiffness[i] >= 0.0 && damping[i] >= 0.0);
        points_.push_back(points[i]);
        offsets_.push_back(offsets[i]);
        stiffness_.push_back(stiffness[i]);
        damping_.push_back(damping[i]);
    }
}

template <class Real>
void Anchor<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    const PosePath::Frame frame = path_.at(motion.t);
    const auto begin = std::lower_bound(points_.begin(), points_.end(), first);
    const auto end = std::lower_bound(begin, points_.end(), last);
    for (auto point = begin; point != end; ++point) {
        const auto p = static_cast<std::size_t>(point - points_.begin());
        const glm::dvec3 arm = frame.arm(offsets_[p]), velocity = frame.velocityOf(arm);
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + *point;
            const double away = static_cast<double>(motion.x[i]) - (frame.place[axis] + arm[axis]);
            const double speed = static_cast<double>(motion.v[i]) - velocity[axis];
            f[i] += static_cast<Real>(-stiffness_[p] * away - damping_[p] * speed);
        }
    }
}

template <class Real>
double Anchor<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    const PosePath::Frame frame = path_.at(motion.t);
    double energy = 0.0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (!only.empty() && !only[static_cast<std::size_t>(points_[p])]) continue;
        const glm::dvec3 arm = frame.arm(offsets_[p]);
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
            const double away = static_cast<double>(motion.x[i]) - (frame.place[axis] + arm[axis]);
            energy += 0.5 * stiffness_[p] * away * away;
        }
    }
    return energy;
}

template <class Real>
void Anchor<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    for (std::size_t p = 0; p < points_.size(); ++p)
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
            out[i] += static_cast<Real>(stiffness_[p]) * u[i];
        }
}

template <class Real>
void Anchor<Real>::linearise(const Motion<Real>&, double stiffness, double damping) {
    weight_.resize(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p)
        weight_[p] = static_cast<Real>(stiffness * stiffness_[p] + damping * damping_[p]);
}

template <class Real>
void Anchor<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (std::size_t p = 0; p < weight_.size(); ++p)
        for (int axis = 0; axis < 3; ++axis)
            out[axis * stride + points_[p]] += weight_[p] * u[axis * stride + points_[p]];
}

template <class Real>
void Anchor<Real>::addDiagonal(int stride, Real* out) const {
    for (std::size_t p = 0; p < weight_.size(); ++p)
        for (int axis = 0; axis < 3; ++axis) out[axis * stride + points_[p]] += weight_[p];
}

template <class Real>
void Anchor<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const auto i = static_cast<std::size_t>(points_[p]);
        share.stiffness[i] += stiffness_[p];
        share.dampingRate[i] += damping_[p] * static_cast<double>(motion.inverseMass[i]);
    }
}

template class Anchor<float>;
template class Anchor<double>;

}  // namespace taut::mechanics
