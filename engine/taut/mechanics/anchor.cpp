#include "taut/mechanics/private/anchor.h"

#include <algorithm>
#include <cmath>
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
                     std::vector<double> damping, std::vector<glm::dvec3> offsets, std::vector<double> most,
                     std::vector<double> lengths)
    : path_(LinearPath{place, place, 0.0, 0.0}) {
    TAUT_EXPECTS(stiffness.size() == points.size() && damping.size() == points.size());
    TAUT_EXPECTS(offsets.empty() || offsets.size() == points.size());
    TAUT_EXPECTS(most.empty() || most.size() == points.size());
    TAUT_EXPECTS(lengths.empty() || (lengths.size() == points.size() && most.empty()));
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
        if (!most.empty()) most_.push_back(most[i]);
        if (!lengths.empty()) lengths_.push_back(lengths[i]);
    }
}

template <class Real>
glm::dvec3 Anchor<Real>::away(const Motion<Real>& motion, const PosePath::Frame& frame, std::size_t p) const {
    const glm::dvec3 arm = frame.arm(offsets_[p]);
    glm::dvec3 away;
    for (int axis = 0; axis < 3; ++axis) {
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
        away[axis] = static_cast<double>(motion.x[i]) - (frame.place[axis] + arm[axis]);
    }
    return away;
}

template <class Real>
glm::dvec3 Anchor<Real>::pull(const Motion<Real>& motion, const PosePath::Frame& frame, std::size_t p) const {
    const glm::dvec3 velocity = frame.velocityOf(frame.arm(offsets_[p])), away = this->away(motion, frame, p);
    glm::dvec3 speed, force;
    for (int axis = 0; axis < 3; ++axis) {
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
        speed[axis] = static_cast<double>(motion.v[i]) - velocity[axis];
        force[axis] = -stiffness_[p] * away[axis] - damping_[p] * speed[axis];
    }
    if (lengths_.empty() || lengths_[p] == 0.0) return force;
    const double distance = std::sqrt(glm::dot(away, away));
    if (!(distance > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 along = away / distance;
    return -(stiffness_[p] * (distance - lengths_[p]) + damping_[p] * glm::dot(speed, along)) * along;
}

template <class Real>
typename Anchor<Real>::Slope Anchor<Real>::cut(const glm::dvec3& pull, std::size_t p) const {
    const double square = glm::dot(pull, pull);
    if (most_.empty() || !(square > most_[p] * most_[p])) return {};
    const double length = std::sqrt(square);
    return {most_[p] / length, pull / length};
}

template <class Real>
typename Anchor<Real>::Slope Anchor<Real>::slope(const Motion<Real>& motion, const PosePath::Frame& frame,
                                                 std::size_t p) const {
    if (lengths_.empty() || lengths_[p] == 0.0) return cut(pull(motion, frame, p), p);
    const glm::dvec3 away = this->away(motion, frame, p);
    const double distance = std::sqrt(glm::dot(away, away));
    if (!(distance > 0.0)) return {0.0};
    return {std::max(0.0, 1.0 - lengths_[p] / distance), away / distance, 1.0};
}

// Where the force is cut, the energy is quadratic up to the distance where it reaches its largest, and linear from
// there on.
template <class Real>
double Anchor<Real>::energy(std::size_t p, double distance) const {
    if (!lengths_.empty()) return 0.5 * stiffness_[p] * (distance - lengths_[p]) * (distance - lengths_[p]);
    const double force = std::min(stiffness_[p] * distance, most_[p]);
    return stiffness_[p] > 0.0 ? force * (distance - 0.5 * force / stiffness_[p]) : 0.0;
}

template <class Real>
void Anchor<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    const PosePath::Frame frame = path_.at(motion.t);
    const auto begin = std::lower_bound(points_.begin(), points_.end(), first);
    const auto end = std::lower_bound(begin, points_.end(), last);
    for (auto point = begin; point != end; ++point) {
        const auto p = static_cast<std::size_t>(point - points_.begin());
        glm::dvec3 force = pull(motion, frame, p);
        if (!most_.empty()) force *= cut(force, p).share;
        for (int axis = 0; axis < 3; ++axis)
            f[static_cast<std::ptrdiff_t>(axis) * motion.stride + *point] += static_cast<Real>(force[axis]);
    }
}

template <class Real>
double Anchor<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    const PosePath::Frame frame = path_.at(motion.t);
    const bool isPlain = most_.empty() && lengths_.empty();
    double energy = 0.0;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (!only.empty() && !only[points_[p]]) continue;
        const glm::dvec3 arm = frame.arm(offsets_[p]);
        double square = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(axis) * motion.stride + points_[p];
            const double away = static_cast<double>(motion.x[i]) - (frame.place[axis] + arm[axis]);
            if (isPlain) energy += 0.5 * stiffness_[p] * away * away;
            square += away * away;
        }
        if (!isPlain) energy += this->energy(p, std::sqrt(square));
    }
    return energy;
}

template <class Real>
void Anchor<Real>::addProduct(std::size_t p, Real weight, const Slope& slope, int stride, const Real* u,
                              Real* out) const {
    const auto at = [&](int axis) { return static_cast<std::ptrdiff_t>(axis) * stride + points_[p]; };
    double along = 0.0;
    if (slope.share < 1.0)
        for (int axis = 0; axis < 3; ++axis) along += slope.along[axis] * static_cast<double>(u[at(axis)]);
    for (int axis = 0; axis < 3; ++axis) {
        const Real change =
            slope.share < 1.0
                ? static_cast<Real>(slope.share * (static_cast<double>(u[at(axis)]) - along * slope.along[axis]) +
                                    slope.alongShare * along * slope.along[axis])
                : u[at(axis)];
        out[at(axis)] += weight * change;
    }
}

template <class Real>
void Anchor<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    const PosePath::Frame frame = path_.at(motion.t);
    for (std::size_t p = 0; p < points_.size(); ++p)
        addProduct(p, static_cast<Real>(stiffness_[p]), slope(motion, frame, p), motion.stride, u, out);
}

template <class Real>
void Anchor<Real>::linearise(const Motion<Real>& motion, double stiffness, double damping) {
    const PosePath::Frame frame = path_.at(motion.t);
    weight_.resize(points_.size());
    slopes_.resize(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) {
        weight_[p] = static_cast<Real>(stiffness * stiffness_[p] + damping * damping_[p]);
        slopes_[p] = slope(motion, frame, p);
        // Of a spring with a length the dashpot acts along it alone.
        if (!lengths_.empty() && lengths_[p] > 0.0 && weight_[p] > Real(0))
            slopes_[p].share *= stiffness * stiffness_[p] / static_cast<double>(weight_[p]);
    }
}

template <class Real>
void Anchor<Real>::addProduct(int stride, const Real* u, Real* out) const {
    for (std::size_t p = 0; p < weight_.size(); ++p) addProduct(p, weight_[p], slopes_[p], stride, u, out);
}

template <class Real>
void Anchor<Real>::addDiagonal(int stride, Real* out) const {
    for (std::size_t p = 0; p < weight_.size(); ++p)
        for (int axis = 0; axis < 3; ++axis) {
            const double along = slopes_[p].along[axis];
            out[static_cast<std::ptrdiff_t>(axis) * stride + points_[p]] +=
                weight_[p] *
                static_cast<Real>(slopes_[p].share * (1.0 - along * along) + slopes_[p].alongShare * along * along);
        }
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
