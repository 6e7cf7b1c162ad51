#include "mechanics/anchor.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace taut::mechanics {

template <class Real>
Anchor<Real>::Anchor(std::vector<int> points, const glm::dvec3& place, double stiffness, double damping,
                     std::vector<glm::dvec3> offsets)
    : place_{place, place, 0.0, 0.0}, stiffness_(stiffness), damping_(damping) {
    TAUT_EXPECTS(stiffness >= 0.0 && damping >= 0.0);
    TAUT_EXPECTS(offsets.empty() || offsets.size() == points.size());
    offsets.resize(points.size(), glm::dvec3(0.0));
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
    for (std::size_t i : order) {
        TAUT_EXPECTS(points_.empty() || points_.back() != points[i]);
        points_.push_back(points[i]);
        offsets_.push_back(offsets[i]);
    }
}

template <class Real>
void Anchor<Real>::setStiffness(double stiffness, double damping) {
    TAUT_EXPECTS(stiffness >= 0.0 && damping >= 0.0);
    stiffness_ = stiffness;
    damping_ = damping;
}

template <class Real>
void Anchor<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    const glm::dvec3 place = place_.at(motion.t), velocity = place_.rate(motion.t);
    const auto begin = std::lower_bound(points_.begin(), points_.end(), first);
    const auto end = std::lower_bound(begin, points_.end(), last);
    for (auto point = begin; point != end; ++point) {
        const glm::dvec3& offset = offsets_[static_cast<std::size_t>(point - points_.begin())];
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + *point;
            const double away = static_cast<double>(motion.x[i]) - (place[axis] + offset[axis]);
            const double speed = static_cast<double>(motion.v[i]) - velocity[axis];
            f[i] += static_cast<Real>(-stiffness_ * away - damping_ * speed);
        }
    }
}

template <class Real>
double Anchor<Real>::potentialEnergy(const Motion<Real>& motion) const {
    const glm::dvec3 place = place_.at(motion.t);
    double energy = 0.0;
    for (std::size_t p = 0; p < points_.size(); ++p)
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
            const double away = static_cast<double>(motion.x[i]) - (place[axis] + offsets_[p][axis]);
            energy += 0.5 * stiffness_ * away * away;
        }
    return energy;
}

template <class Real>
void Anchor<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    const Real k = static_cast<Real>(stiffness_);
    for (int point : points_)
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + point;
            out[i] += k * u[i];
        }
}

template <class Real>
void Anchor<Real>::linearise(const Motion<Real>&, double stiffness, double damping) {
    weight_ = static_cast<Real>(stiffness * stiffness_ + damping * damping_);
}

template <class Real>
void Anchor<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (int point : points_)
        for (int axis = 0; axis < 3; ++axis) out[axis * stride + point] += weight_ * u[axis * stride + point];
}

template <class Real>
void Anchor<Real>::addDiagonal(int stride, Real* out) const {
    for (int point : points_)
        for (int axis = 0; axis < 3; ++axis) out[axis * stride + point] += weight_;
}

template <class Real>
void Anchor<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    for (int point : points_) {
        const auto i = static_cast<std::size_t>(point);
        share.stiffness[i] += stiffness_;
        share.dampingRate[i] += damping_ * static_cast<double>(motion.inverseMass[point]);
    }
}

template class Anchor<float>;
template class Anchor<double>;

}  // namespace taut::mechanics
