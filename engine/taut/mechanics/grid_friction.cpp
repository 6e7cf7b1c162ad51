#include "taut/mechanics/private/grid_friction.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/vectorise.h"
#include "taut/mechanics/pose_path.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;

constexpr int frictionRowsATask = 32;

template <class Real>
Real within(Real most, Real value) {
    return value < -most ? -most : value > most ? most : value;
}

// The slider after a fold has come to this. One that holds keeps its bits.
template <class Real>
Real slid(Real most, Real fold, Real slider) {
    const Real stretch = fold - slider;
    return stretch < -most ? fold + most : stretch > most ? fold - most : slider;
}

template <class Real>
dvec3 placeAt(const Motion<Real>& motion, int point) {
    const std::ptrdiff_t stride = motion.stride;
    return {static_cast<double>(motion.x[point]), static_cast<double>(motion.x[stride + point]),
            static_cast<double>(motion.x[2 * stride + point])};
}

}  // namespace

// Both folds at a point.
template <class Real>
struct GridFriction<Real>::Fold {
    using Vector = glm::vec<3, Real, glm::defaultp>;
    Vector u, w, d, e, normal;
    Real inverse;        // 1/|u × w|
    Real share;          // 1; 0 where n is not of length 1
    Real along, across;  // [m] n·d, n·e
};

template <class Real>
std::size_t GridFriction<Real>::sliderCount(const BendingFriction& friction, bool mayClamp) {
    return static_cast<std::size_t>(friction.stuck.columns * friction.stuck.rows) * (mayClamp ? 4 : 2);
}

template <class Real>
GridFriction<Real>::GridFriction(BendingFriction friction, std::span<const int> points, std::span<Real> sliders,
                                 Turn turn)
    : friction_(friction),
      stuck_(friction.stuck, points, turn),
      points_(points.begin(), points.end()),
      sliders_(sliders),
      turn_(std::move(turn)),
      places_(3 * points_.size()),
      pulls_(12 * (points_.size() + 2 * static_cast<std::size_t>(friction.stuck.columns))) {
    for (std::size_t i = 1; i < points_.size(); ++i) isInOrder_ = isInOrder_ && points_[i] == points_[i - 1] + 1;
    set(std::move(friction));
}

template <class Real>
void GridFriction<Real>::set(BendingFriction friction) {
    TAUT_EXPECTS(sliders_.size() >= sliderCount(friction, !friction.stuck.clamps.empty()));
    friction_ = std::move(friction);
    stuck_.set(friction_.stuck);
    along_ = across_ = core::AlignedArray<Real>(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        along_[i] = static_cast<Real>(friction_.stuck.along[i]);
        across_[i] = static_cast<Real>(friction_.stuck.across[i]);
    }
    mostAlong_ = static_cast<Real>(friction_.yield * friction_.cell.x * friction_.cell.x);
    mostAcross_ = static_cast<Real>(friction_.yield * friction_.cell.y * friction_.cell.y);
}

// Points that follow each other are read where they are.
template <class Real>
void GridFriction<Real>::gather(const Motion<Real>& motion) const {
    x_ = {motion.x + points_.front(), motion.stride};
    if (isInOrder_) return;
    x_ = {places_.data(), size()};
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
        const Real* from = motion.x + axis * motion.stride;
        Real* to = places_.data() + axis * size();
        for (std::size_t i = 0; i < points_.size(); ++i) to[i] = from[points_[i]];
    }
}

template <class Real>
template <class Each>
void GridFriction<Real>::forEachPart(const Each& each) const {
    const int n = friction_.stuck.columns, rows = friction_.stuck.rows;
    const auto task = [&](int number) {
        const int first = number * frictionRowsATask;
        for (int row = first; row < std::min(first + frictionRowsATask, rows); ++row) {
            const int up = row > 0 ? -n : 0, down = row + 1 < rows ? n : 0;
            const auto part = [&](int begin, int end, int left, int right) {
                const double cells = 1.0 * (right - left) * (down - up) / n;
                each(Part{row * n + begin, row * n + end, left, right, up, down,
                          static_cast<Real>(0.5 * cells * friction_.cell.x * friction_.cell.y)});
            };
            part(0, 1, 0, 1);
            part(1, n - 1, -1, 1);
            part(n - 1, n, -1, 0);
        }
    };
    core::parallelFor((rows + frictionRowsATask - 1) / frictionRowsATask, task);
}

// Differences of edges, not of places, so that single precision loses as little as possible.
template <class Real>
[[gnu::always_inline]] inline auto GridFriction<Real>::foldAt(const Part& part, int i) const -> Fold {
    const Real *x = x_.of + i, *y = x + x_.stride, *z = y + x_.stride;
    const auto edge = [&](int to) { return typename Fold::Vector(x[to] - x[0], y[to] - y[0], z[to] - z[0]); };
    const auto p = edge(part.left), r = edge(part.right), q = edge(part.up), s = edge(part.down);
    Fold fold{r - p, s - q, r + p, s + q, {}, 0, 0, 0, 0};
    const auto area = glm::cross(fold.u, fold.w);
    const Real length = std::sqrt(glm::dot(area, area));
    fold.share = length > part.least ? Real(1) : Real(0);
    fold.inverse = Real(1) / (length > part.least ? length : part.least);
    fold.normal = fold.inverse * area;
    fold.along = glm::dot(fold.normal, fold.d);
    fold.across = glm::dot(fold.normal, fold.e);
    return fold;
}

// Of a fold that is gone the slider stays.
template <class Real>
void GridFriction<Real>::slide(const Motion<Real>& motion) {
    gather(motion);
    forEachPart([&](const Part& part) {
        Real *along = sliders_.data(), *across = along + size();
        const Real *stiffU = along_.data(), *stiffV = across_.data();
        const Real mostU = mostAlong_, mostV = mostAcross_;
        TAUT_INDEPENDENT
        for (int i = part.first; i < part.last; ++i) {
            const Fold fold = foldAt(part, i);
            const Real u = along[i], v = across[i];
            const Real nextU = slid(mostU, fold.along, u), nextV = slid(mostV, fold.across, v);
            along[i] = stiffU[i] == 0 ? u : nextU;
            across[i] = stiffV[i] == 0 ? v : nextV;
        }
    });
    for (const Bending::Clamp& clamp : friction_.stuck.clamps) {
        const Slot slot = slotOf(clamp);
        sliders_[slot.slider] = slid(slot.most, foldAt(clamp, motion), sliders_[slot.slider]);
    }
}

// The slope of the energy of the two folds, m their moments over a² and b²:
//
//   m_u n·δd + m_v n·δe + (m_u d + m_v e)·δn,   δn = (1 - n nᵀ)(δu × w + u × δw)/|u × w|
//
// Where a neighbour is missing c itself stands for it. Its fold has no moment then, and the force that turns n goes to
// c.
template <class Real>
void GridFriction<Real>::findPulls(const Part& part) const {
    const Real *along = sliders_.data(), *across = along + size();
    const Real *stiffU = along_.data(), *stiffV = across_.data();
    const Real mostU = mostAlong_, mostV = mostAcross_;
    Real* const pulls = pullsOn(0, 0);
    const std::ptrdiff_t plane = pullsOn(0, 1) - pulls;
    const Real p = part.left != 0 ? Real(1) : Real(0), r = part.right != 0 ? Real(1) : Real(0),
               q = part.up != 0 ? Real(1) : Real(0), s = part.down != 0 ? Real(1) : Real(0);
    TAUT_INDEPENDENT
    for (int i = part.first; i < part.last; ++i) {
        const Fold fold = foldAt(part, i);
        const Real alongMoment = stiffU[i] * within(mostU, fold.along - along[i]),
                   acrossMoment = stiffV[i] * within(mostV, fold.across - across[i]);
        const auto turning =
            fold.inverse * (alongMoment * fold.d + acrossMoment * fold.e -
                            fold.share * (alongMoment * fold.along + acrossMoment * fold.across) * fold.normal);
        const auto onU = glm::cross(fold.w, turning), onW = glm::cross(turning, fold.u);
        const auto onD = alongMoment * fold.normal, onE = acrossMoment * fold.normal;
        const auto put = [&](int which, const typename Fold::Vector& pull) {
            pulls[3 * which * plane + i] = pull.x;
            pulls[(3 * which + 1) * plane + i] = pull.y;
            pulls[(3 * which + 2) * plane + i] = pull.z;
        };
        put(0, p * (onD - onU));
        put(1, r * (onD + onU));
        put(2, q * (onE - onW));
        put(3, s * (onE + onW));
    }
}

// Each point takes the pulls at its neighbours, and is itself the neighbour of four. Pulls at rows and columns that
// are not there are 0.
template <class Real>
void GridFriction<Real>::addPulls(const Part& part, int stride, Real* f) const {
    const int n = friction_.stuck.columns;
    for (int axis = 0; axis < 3; ++axis) {
        const Real *p = pullsOn(0, axis), *r = pullsOn(1, axis), *q = pullsOn(2, axis), *s = pullsOn(3, axis);
        Real* to = f + static_cast<std::ptrdiff_t>(axis) * stride;
        const auto sum = [&](int i) {
            return ((p[i] - p[i + 1]) + (r[i] - r[i - 1])) + ((q[i] - q[i + n]) + (s[i] - s[i - n]));
        };
        if (!isInOrder_) {
            for (int i = part.first; i < part.last; ++i) to[numberOf(i)] += sum(i);
            continue;
        }
        to += points_.front();
        TAUT_INDEPENDENT
        for (int i = part.first; i < part.last; ++i) to[i] += sum(i);
    }
}

template <class Real>
void GridFriction<Real>::addForces(const Motion<Real>& motion, int first, int last, Real* f) const {
    TAUT_EXPECTS(first == 0 && last == motion.count);
    gather(motion);
    forEachPart([&](const Part& part) { findPulls(part); });
    forEachPart([&](const Part& part) { addPulls(part, motion.stride, f); });
    if (friction_.stuck.clamps.empty()) return;
    const dvec3 normal = normalAt(motion.t);
    for (const Bending::Clamp& clamp : friction_.stuck.clamps) {
        const Slot slot = slotOf(clamp);
        const double force = -0.5 * clamp.stiffness * within(slot.most, foldAt(clamp, motion) - sliders_[slot.slider]);
        for (std::ptrdiff_t axis = 0; axis < 3; ++axis)
            f[axis * motion.stride + numberOf(clamp.next)] += static_cast<Real>(force * normal[static_cast<int>(axis)]);
    }
}

template <class Real>
double GridFriction<Real>::potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only) const {
    const auto counts = [&](int i) { return only.empty() || only[numberOf(i)]; };
    const auto stored = [](double stiffness, Real most, Real stretch) {
        const double held = within(most, stretch);
        return 0.5 * stiffness * held * held;
    };
    gather(motion);
    std::vector<double> energies(points_.size());
    forEachPart([&](const Part& part) {
        for (int i = part.first; i < part.last; ++i) {
            if (!counts(i + part.left) || !counts(i) || !counts(i + part.right) || !counts(i + part.up) ||
                !counts(i + part.down))
                continue;
            const Fold fold = foldAt(part, i);
            const auto own = static_cast<std::size_t>(i), other = own + points_.size();
            energies[own] = stored(along_[own], mostAlong_, fold.along - sliders_[own]) +
                            stored(across_[own], mostAcross_, fold.across - sliders_[other]);
        }
    });
    double energy = 0;
    for (const double one : energies) energy += one;
    for (const Bending::Clamp& clamp : friction_.stuck.clamps)
        if (counts(clamp.next))
            energy += stored(0.25 * clamp.stiffness, slotOf(clamp).most,
                             foldAt(clamp, motion) - sliders_[slotOf(clamp).slider]);
    return energy;
}

template <class Real>
auto GridFriction<Real>::slotOf(const Bending::Clamp& clamp) const -> Slot {
    const bool isAcross = std::abs(clamp.next - clamp.held) > 1, isBefore = clamp.next < clamp.held;
    const int plane = (isAcross ? 1 : 0) + (isBefore ? 2 : 0);
    return {static_cast<std::size_t>(plane * size() + clamp.held), isAcross ? mostAcross_ : mostAlong_};
}

template <class Real>
dvec3 GridFriction<Real>::normalAt(double t) const {
    return turn_ ? PosePath::rotated(turn_(t), friction_.front) : friction_.front;
}

// Its half cell bends as a fold does whose other side is its mirror image.
template <class Real>
Real GridFriction<Real>::foldAt(const Bending::Clamp& clamp, const Motion<Real>& motion) const {
    const dvec3 normal = normalAt(motion.t);
    const dvec3 off = placeAt(motion, numberOf(clamp.next)) - placeAt(motion, numberOf(clamp.held));
    // The arm lies in the sheet, so that it has no part along n.
    return static_cast<Real>(2.0 * glm::dot(normal, off));
}

template class GridFriction<float>;
template class GridFriction<double>;

}  // namespace taut::mechanics
