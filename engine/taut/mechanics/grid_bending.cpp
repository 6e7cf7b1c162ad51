#include "taut/mechanics/private/grid_bending.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/vectorise.h"
#include "taut/mechanics/bending.h"
#include "taut/mechanics/pose_path.h"

namespace taut::mechanics {

TAUT_KERNELS(template <class Real> void addBending(const BendingBatch<Real>&);)

namespace {

using glm::dvec3;

constexpr int rowsATask = 64;

template <class Real>
dvec3 at(const Real* x, std::ptrdiff_t stride, int point) {
    return {static_cast<double>(x[point]), static_cast<double>(x[stride + point]),
            static_cast<double>(x[2 * stride + point])};
}

// The coefficient of twist, if all cells have the same.
std::optional<double> evenTwist(const Bending& bending) {
    const double first = bending.twist.front();
    for (int j = 0; j + 1 < bending.rows; ++j)
        for (int i = 0; i + 1 < bending.columns; ++i)
            if (bending.twist[j * bending.columns + i] != first) return std::nullopt;
    return first;
}

}  // namespace

template <class Real>
GridBending<Real>::GridBending(Bending bending, std::span<const int> points, Turn turn)
    : points_(points.begin(), points.end()), turn_(std::move(turn)), add_(TAUT_IN_USE(addBending<Real>)) {
    bending_.columns = bending.columns;
    bending_.rows = bending.rows;
    TAUT_EXPECTS(!bending.isEmpty() && std::ssize(points_) == size());
    isInOrder_ = true;
    for (std::size_t i = 1; i < points_.size(); ++i) isInOrder_ = isInOrder_ && points_[i] == points_[i - 1] + 1;
    places_ = Array(3 * points_.size());
    sums_ = Array(isInOrder_ ? 0 : 3 * points_.size());
    for (int row = 0; row < bending.rows; row += rowsATask)
        rooms_.emplace_back(static_cast<std::size_t>(bendingRoom(bending.columns)));
    set(std::move(bending));
}

template <class Real>
void GridBending<Real>::set(Bending bending) {
    TAUT_EXPECTS(bending.columns == bending_.columns && bending.rows == bending_.rows);
    for (const auto* list : {&bending.along, &bending.across, &bending.both, &bending.twist})
        TAUT_EXPECTS(std::ssize(*list) == size());
    bending_ = std::move(bending);
    forces_ = scaled(1.0);
    stiffness_ = scaled(-1.0);
    products_ = {};
}

template <class Real>
typename GridBending<Real>::Coefficients GridBending<Real>::scaled(double factor) const {
    const auto list = [&](const std::vector<double>& values) {
        Array scaled(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) scaled[i] = static_cast<Real>(factor * values[i]);
        return scaled;
    };
    const auto isNone = [](double value) { return value == 0; };
    const bool hasBoth = !std::all_of(bending_.both.begin(), bending_.both.end(), isNone);
    const std::optional<double> even = evenTwist(bending_);
    return {list(bending_.along), list(bending_.across), hasBoth ? list(bending_.both) : Array(),
            even ? Array() : list(bending_.twist), static_cast<Real>(factor * even.value_or(0))};
}

// x + τ v of the grid's points. Without v or τ it is x, without a copy if the points are in order.
template <class Real>
typename GridBending<Real>::Planes GridBending<Real>::gathered(const Real* x, const Real* v, double dampingTime,
                                                               int stride) const {
    const bool isDamped = v != nullptr && dampingTime > 0;
    if (isInOrder_ && !isDamped) return {x + points_.front(), stride};
    const auto tau = static_cast<Real>(dampingTime);
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
        const Real *from = x + axis * stride, *moving = isDamped ? v + axis * stride : nullptr;
        Real* to = places_.data() + axis * size();
        if (isInOrder_) {
            from += points_.front();
            moving += points_.front();
            const int count = size();
            TAUT_INDEPENDENT
            for (int i = 0; i < count; ++i) to[i] = from[i] + tau * moving[i];
            continue;
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const int point = points_[i];
            to[i] = isDamped ? from[point] + tau * moving[point] : from[point];
        }
    }
    return {places_.data(), size()};
}

template <class Real>
void GridBending<Real>::apply(const Coefficients& coefficients, Planes x, int stride, Real* f) const {
    BendingBatch<Real> batch{};
    batch.columns = bending_.columns;
    batch.rows = bending_.rows;
    batch.along = coefficients.along.data();
    batch.across = coefficients.across.data();
    batch.both = coefficients.both.empty() ? nullptr : coefficients.both.data();
    batch.twist = coefficients.twist.empty() ? nullptr : coefficients.twist.data();
    batch.evenTwist = coefficients.evenTwist;
    if (!isInOrder_) std::fill(sums_.begin(), sums_.end(), Real(0));
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
        batch.x[axis] = x.x + axis * x.stride;
        batch.f[axis] = isInOrder_ ? f + axis * stride + points_.front() : sums_.data() + axis * size();
    }
    const auto part = [&](int task) {
        BendingBatch<Real> own = batch;
        own.first = task * rowsATask;
        own.last = std::min(own.first + rowsATask, bending_.rows);
        own.room = rooms_[task].data();
        add_(own);
    };
    if (rooms_.size() == 1)
        part(0);
    else
        core::parallelFor(static_cast<int>(rooms_.size()), part);
    if (isInOrder_) return;
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < points_.size(); ++i)
            f[axis * stride + points_[i]] += sums_[static_cast<std::size_t>(axis) * points_.size() + i];
}

template <class Real>
dvec3 GridBending<Real>::armAt(const Bending::Clamp& clamp, double t) const {
    return turn_ ? PosePath::rotated(turn_(t), clamp.arm) : clamp.arm;
}

template <class Real>
void GridBending<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    const int stride = motion.stride;
    apply(forces_, gathered(motion.x, motion.v, bending_.dampingTime, stride), stride, f);
    for (const Bending::Clamp& clamp : bending_.clamps) {
        const int held = points_[clamp.held], next = points_[clamp.next];
        const dvec3 off = at(motion.x, stride, next) - at(motion.x, stride, held) - armAt(clamp, motion.t);
        const dvec3 drift = at(motion.v, stride, next) - at(motion.v, stride, held);
        const dvec3 force = -clamp.stiffness * (off + bending_.dampingTime * drift);
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
            f[axis * stride + next] += static_cast<Real>(force[static_cast<int>(axis)]);
    }
}

template <class Real>
double GridBending<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    const auto numberOf = [&](int point) { return points_[point]; };
    const auto counts = [&](int point) { return only.empty() || only[numberOf(point)]; };
    double energy = 0;
    eachTerm(bending_, [&](const BendingTerm& term) {
        if (!std::all_of(term.points, term.points + term.count, counts)) return;
        dvec3 sum(0.0);
        for (int k = 0; k < term.count; ++k)
            sum += term.weights[k] * at(motion.x, motion.stride, numberOf(term.points[k]));
        energy += 0.5 * term.coefficient * glm::dot(sum, sum);
    });
    for (const Bending::Clamp& clamp : bending_.clamps) {
        if (!counts(clamp.next)) continue;
        const dvec3 off = at(motion.x, motion.stride, numberOf(clamp.next)) -
                          at(motion.x, motion.stride, numberOf(clamp.held)) - armAt(clamp, motion.t);
        energy += 0.5 * clamp.stiffness * glm::dot(off, off);
    }
    return energy;
}

template <class Real>
void GridBending<Real>::addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const {
    apply(stiffness_, gathered(u, nullptr, 0, motion.stride), motion.stride, out);
    for (const Bending::Clamp& clamp : bending_.clamps)
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
            const auto next = axis * motion.stride + points_[clamp.next];
            out[next] += static_cast<Real>(clamp.stiffness) * u[next];
        }
}

template <class Real>
void GridBending<Real>::linearise(const Motion<Real>&, double stiffness, double damping) {
    const double factor = stiffness + damping * bending_.dampingTime;
    if (factor == productFactor_ && !products_.along.empty()) return;
    products_ = scaled(-factor);
    productFactor_ = factor;
}

template <class Real>
void GridBending<Real>::addProduct(int stride, const Real* u, Real* out) const {
    apply(products_, gathered(u, nullptr, 0, stride), stride, out);
    for (const Bending::Clamp& clamp : bending_.clamps)
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
            const auto next = axis * stride + points_[clamp.next];
            out[next] += static_cast<Real>(productFactor_ * clamp.stiffness) * u[next];
        }
}

template <class Real>
void GridBending<Real>::addDiagonal(int stride, Real* out) const {
    const auto add = [&](int point, double more) {
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
            out[axis * stride + points_[point]] += static_cast<Real>(productFactor_ * more);
    };
    eachTerm(bending_, [&](const BendingTerm& term) {
        for (int k = 0; k < term.count; ++k) add(term.points[k], term.coefficient * term.weights[k] * term.weights[k]);
    });
    for (const Bending::Clamp& clamp : bending_.clamps) add(clamp.next, clamp.stiffness);
}

// Each term that has a point with the weight w adds |w| Σ|weights| times its coefficient to the row sum of the point.
template <class Real>
void GridBending<Real>::addStability(const Motion<Real>& motion, StabilityShare& share) const {
    const auto add = [&](int point, double row) {
        const auto own = static_cast<std::size_t>(points_[point]);
        share.stiffness[own] += row;
        share.dampingRate[own] += bending_.dampingTime * row * static_cast<double>(motion.inverseMass[own]);
    };
    eachTerm(bending_, [&](const BendingTerm& term) {
        double weights = 0;
        for (int k = 0; k < term.count; ++k) weights += std::abs(term.weights[k]);
        for (int k = 0; k < term.count; ++k)
            add(term.points[k], std::abs(term.coefficient * term.weights[k]) * weights);
    });
    for (const Bending::Clamp& clamp : bending_.clamps) add(clamp.next, clamp.stiffness);
}

template class GridBending<float>;
template class GridBending<double>;

}  // namespace taut::mechanics
