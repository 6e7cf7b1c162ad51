// Measures how bringing points out of colliders changes the energy of an island. It knows no method.
//
// Why it is measured. A contact is resolved by moving a point out of the collider and by an impulse (position
// projection). The impulse adds no energy, for restitution is at most 1. The move does work against the springs and
// cells at the point, and against gravity. Nothing bounds that work: it grows with the depth, which grows with speed
// times step. So the island measures it, and takes shorter steps where the sum becomes a share of the energy that there
// was at a touch (ContactBudget in memory.h).
//
// Why local sums are enough. Resolving contacts changes x and v of some points only. The energy of everything else is
// the same before and after, so the difference of
//   E(points) = Σ ½ m v² - m g·x  +  Σ ½ k (l - L)² of springs at them  +  Σ ½ K V0 (V/V0 - 1)² of cells at them
// over those points is the difference of the whole. A spring between two of them counts once, and a cell counts once
// for all its corners. Held points have no energy of their own. Anchors, hands and bending are soft beside these
// springs and are left out.
//
// Which velocities. Methods store v at other times than x; both sums take v at the time of the positions. A surface
// that moves does work of its own, which is no error: then v is taken relative to the surface.
//
// One thread adds them up, in double precision and in the order of the points given.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "taut/island/private/dynamics.h"
#include "taut/island/private/planar.h"
#include "taut/mechanics/private/cell_shape.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

template <class Real>
class ContactWatch {
  public:
    using Planes = core::AlignedArray<Real>;

    bool isOn() const { return !springsAt_.empty(); }
    // stride: of the planes. Each array of planes has three times that size.
    void start(const IslandPlan& plan, std::vector<mechanics::VolumeCell> cells, int stride) {
        planar_.stride = stride;
        x = v = w = vStart = Planes(3 * static_cast<std::size_t>(stride));
        cells_ = std::move(cells);
        springsAt_.assign(plan.points.size(), {});
        cellsAt_.assign(plan.points.size(), {});
        for (std::size_t s = 0; s < plan.springs.size(); ++s)
            for (int end : {plan.springs[s].a, plan.springs[s].b}) springsAt_[end].push_back(static_cast<int>(s));
        for (std::size_t c = 0; c < cells_.size(); ++c)
            for (int corner : cells_[c].points) cellsAt_[corner].push_back(static_cast<int>(c));
        isCounted_.assign(plan.points.size(), false);
    }

    // Keeps the state before contacts are resolved: places, stored velocities, and velocities at the time of the
    // places.
    void remember(const Planes& places, const Planes& stored, const Real* velocities) {
        std::copy(places.begin(), places.end(), x.begin());
        std::copy(stored.begin(), stored.end(), v.begin());
        std::copy_n(velocities, w.size(), w.begin());
    }
    // At the first touch since take(): measures how much energy there is.
    void meetAtTouch(const IslandPlan& plan, const dvec3& gravity) {
        if (!(work_.atTouch > 0)) work_.atTouch = whole(plan, gravity);
    }
    void add(double work) { work_.added += work; }  // [J]
    ContactWork take() { return std::exchange(work_, {}); }

    // [J] Energy of these points (or all) at such places and velocities, with the springs and cells that act on them.
    double energy(const IslandPlan& plan, const std::vector<int>& points, bool isAll, const Planes& places,
                  const Planes& velocities, const dvec3& gravity) {
        const int count = isAll ? static_cast<int>(plan.points.size()) : static_cast<int>(points.size());
        const auto pointAt = [&](int k) { return isAll ? k : points[k]; };
        double sum = 0;
        for (int k = 0; k < count; ++k) {
            const int i = pointAt(k);
            const auto own = static_cast<std::size_t>(i);
            isCounted_[own] = true;
            const dvec3 u = planar_.at(velocities, i);
            if (isFree(plan, i))
                sum += 0.5 * plan.points[own].mass * glm::dot(u, u) -
                       plan.points[own].weighedMass() * glm::dot(gravity, planar_.at(places, i));
            for (int s : springsAt_[own]) {
                const mechanics::Spring& spring = plan.springs[s];
                const int other = spring.a == i ? spring.b : spring.a;
                if (isCounted_[other] && other != i) continue;
                const dvec3 d = planar_.at(places, spring.b) - planar_.at(places, spring.a);
                const double stretch = std::sqrt(glm::dot(d, d)) - spring.restLength;
                sum += 0.5 * spring.stiffness * stretch * stretch;
            }
            for (int c : cellsAt_[own]) sum += cellEnergy(cells_[c], i, places);
        }
        for (int k = 0; k < count; ++k) isCounted_[pointAt(k)] = false;
        return sum;
    }

    Planes x{}, v{}, w{};  // as remember() found them
    Planes vStart{};       // of the start of the step, as the method stored it

  private:
    // [J] Energy of all points, with heights over the lowest point.
    double whole(const IslandPlan& plan, const dvec3& gravity) {
        double lowest = std::numeric_limits<double>::infinity(), mass = 0;
        for (int i = 0; i < static_cast<int>(plan.points.size()); ++i) {
            if (!isFree(plan, i)) continue;
            mass += plan.points[i].weighedMass();
            lowest = std::min(lowest, -glm::dot(gravity, planar_.at(x, i)));
        }
        return mass > 0 ? energy(plan, {}, true, x, w, gravity) - mass * lowest : 0.0;
    }

    // Each cell counts at the first of its corners that is counted.
    double cellEnergy(const mechanics::VolumeCell& cell, int point, const Planes& places) const {
        for (int corner : cell.points)
            if (corner != point && isCounted_[corner]) return 0.0;
        return mechanics::volumeEnergy(cell, mechanics::cornersOf(cell, places.data(), planar_.stride));
    }

    Planar<Real> planar_;
    ContactWork work_;
    std::vector<mechanics::VolumeCell> cells_;
    std::vector<std::vector<int>> springsAt_, cellsAt_;  // (points)
    std::vector<bool> isCounted_;                        // (points) scratch
};

}  // namespace taut::world
