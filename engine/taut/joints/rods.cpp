#include "taut/joints/private/rods.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/core/error.h"

namespace taut::world {
namespace {

constexpr double relativeTolerance = 1e-13;  // of a length
constexpr double tautFrom = 1.0 - 1e-9;      // of the length of a leash
constexpr double roundingShare = 1e-15;      // of a coordinate
constexpr int oldPasses = 10;                // along the directions at the start of the step
constexpr int mostPasses = 40;               // afterwards along the present directions, as in the Gauss-Newton method

double norm(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

}  // namespace

// A rod that already exists is not made twice.
void Rods::tie(const Spot& a, const Spot& b, double length, const Source& source, bool isMost) {
    const Spot first = ends_.of(a, rods_), second = ends_.of(b, rods_);
    for (const Rod& rod : rods_)
        if ((rod.a == first && rod.b == second) || (rod.a == second && rod.b == first)) return;
    rods_.push_back({first, second, length, source, isMost});
    pairs_.clear();
}

void Rods::tie(const Spot& a, const Place& b, double length, const Source& source, bool isMost) {
    const Spot first = ends_.of(a, rods_);
    rods_.push_back({first, ends_.of(b), length, source, isMost});
    pairs_.clear();
}

double Rods::strain(std::span<const dvec3> x, const std::vector<bool>& counts) const {
    const auto counted = [&](const Spot& end) {
        return std::all_of(end.shares().begin(), end.shares().end(),
                           [&](const Spot::Share& own) { return counts[static_cast<std::size_t>(own.point)]; });
    };
    double most = 0;
    for (int r = 0; r < size(); ++r) {
        const Rod& rod = rods_[static_cast<std::size_t>(r)];
        const double strain = (norm(between(rod, x)) - rod.length) / rod.length;
        if (holds(r) && counted(rod.a) && counted(rod.b)) most = std::max(most, rod.isMost ? strain : std::abs(strain));
    }
    return most;
}

std::span<const Constraint::Pair> Rods::pairs(double /*t*/) {
    for (int r = 0; r < size() && std::ssize(pairs_) < count(); ++r)
        if (const Rod& rod = rods_[static_cast<std::size_t>(r)]; holds(r))
            pairs_.push_back({rod.a, rod.b, r, rod.length, rod.isMost});
    return pairs_;
}

// A rod under a tension T draws its ends back across, like a spring of T/L. Bounded by Gershgorin's theorem.
double Rods::turning(std::span<const dvec3> x, std::span<const double> inverseMass,
                     std::span<const dvec3> forces) const {
    std::vector<double> sum(inverseMass.size(), 0.0);
    for (int r = 0; r < size(); ++r) {
        const Rod& rod = rods_[static_cast<std::size_t>(r)];
        const double length = norm(between(rod, x));
        if (!holds(r) || !(length > 0)) continue;
        const double stiffness = norm(forces[static_cast<std::size_t>(r)]) / length;
        for (const Spot* end : {&rod.a, &rod.b})
            for (const Spot::Share& own : end->shares())
                for (const Spot::Share& other : end->shares())
                    sum[static_cast<std::size_t>(own.point)] += std::abs(own.weight * other.weight) * stiffness;
    }
    double most = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) most = std::max(most, 2.0 * sum[i] * inverseMass[i]);
    return most;
}

void Rods::check() const {
    for (const Rod& rod : rods_)
        if (!(rod.length > 0))
            throw core::Error(core::ErrorKind::badContent,
                              world::at(rod.source) +
                                  "a rod has both ends in one place; move them apart, or use kind = "
                                  "\"weld\"");
}

// Breadth first from rods with few neighbours, so that neighbours stand near the diagonal (Cuthill and McKee).
// Over 60 lines: order, envelope and couplings come from one walk over the rods.
void Rods::layOut() {
    if (!order_.empty()) return;
    const auto count = rods_.size();
    std::vector<std::vector<Spot::Share>> ends;             // (rods) that move
    std::vector<std::vector<int>> at(ends_.points.size());  // rods at each point
    for (std::size_t r = 0; r < count; ++r) {
        ends.push_back(TieEnds::difference(rods_[r].a, rods_[r].b));
        std::erase_if(ends.back(), [&](const Spot::Share& own) { return ends_.isPlace(own.point); });
        for (const Spot::Share& own : ends.back())
            at[static_cast<std::size_t>(own.point)].push_back(static_cast<int>(r));
    }
    const auto neighbours = [&](int r) {
        std::vector<int> all;
        for (const Spot::Share& own : ends[static_cast<std::size_t>(r)])
            all.insert(all.end(), at[static_cast<std::size_t>(own.point)].begin(),
                       at[static_cast<std::size_t>(own.point)].end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        std::erase(all, r);
        return all;
    };
    std::vector<int> starts(count), rowOf(count, -1);
    std::vector<std::size_t> degree(count);
    for (std::size_t r = 0; r < count; ++r) {
        starts[r] = static_cast<int>(r);
        degree[r] = neighbours(static_cast<int>(r)).size();
    }
    std::stable_sort(starts.begin(), starts.end(), [&](int a, int b) {
        return degree[static_cast<std::size_t>(a)] < degree[static_cast<std::size_t>(b)];
    });
    const auto take = [&](int r) {
        int& row = rowOf[static_cast<std::size_t>(r)];
        if (row >= 0) return;
        row = static_cast<int>(order_.size());
        order_.push_back(r);
    };
    for (const int start : starts) {
        std::size_t next = order_.size();
        take(start);
        for (; next < order_.size(); ++next)
            for (const int r : neighbours(order_[next])) take(r);
    }
    // The couplings of each row and the start of its envelope.
    for (int i = 0; i < static_cast<int>(count); ++i) {
        int first = i;
        for (const auto& [point, weight] : ends[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])])
            for (const int r : at[static_cast<std::size_t>(point)]) {
                const int j = rowOf[static_cast<std::size_t>(r)];
                if (j > i) continue;
                for (const auto& [same, other] : ends[static_cast<std::size_t>(r)])
                    if (same == point) couplings_.push_back({i, j, point, weight * other});
                first = std::min(first, j);
            }
        matrix_.addRow(first);
    }
    diagonal_.resize(count);
    direction_.resize(count);
    impulse_.resize(count);
}

// Factors J M⁻¹ Jᵀ with the rods' directions at x.
void Rods::factor(std::span<const dvec3> x, std::span<const double> inverseMass) {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const dvec3 d = between(rods_[static_cast<std::size_t>(order_[i])], x);
        const double length = norm(d);
        direction_[i] = mayPull(order_[i]) && length > 0 ? d / length : dvec3(0.0);
    }
    matrix_.clear();
    diagonal_.assign(order_.size(), 0.0);
    for (const auto& [i, j, point, weight] : couplings_) {
        const double share = weight * inverseMass[static_cast<std::size_t>(point)];
        if (i == j)
            diagonal_[static_cast<std::size_t>(i)] += share;
        else
            matrix_.at(i, j) +=
                share * glm::dot(direction_[static_cast<std::size_t>(i)], direction_[static_cast<std::size_t>(j)]);
    }
    for (std::size_t i = 0; i < order_.size(); ++i) diagonal_[i] *= glm::dot(direction_[i], direction_[i]);
    matrix_.factor(diagonal_);
}

// A rod turns during a tick, so its pull is summed along its axis.
void Rods::pull(std::span<dvec3> to, const Moment& moment) const {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
        const dvec3 impulse = impulse_[i] * direction_[i];
        rod.a.push(to, moment.inverseMass, impulse);
        rod.b.push(to, moment.inverseMass, -impulse);
        moment.pull[static_cast<std::size_t>(order_[i])].x += impulse_[i];
    }
}

// A leash is taut if it is too long, and stays so for a projection. Its velocities count if they go apart.
void Rods::findTaut(const Moment& moment, bool ofPlaces) {
    isTaut_.resize(rods_.size());
    for (std::size_t r = 0; r < rods_.size(); ++r) {
        const Rod& rod = rods_[r];
        const dvec3 d = between(rod, moment.x);
        isTaut_[r] =
            !rod.isMost || (ofPlaces ? glm::dot(d, d) > rod.length * rod.length
                                     : norm(d) > tautFrom * rod.length && glm::dot(d, between(rod, moment.v)) > 0.0);
    }
}

// Leashes only pull: one whose impulse would push goes slack. Returns whether any did.
bool Rods::slacken() {
    bool isAny = false;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const auto rod = static_cast<std::size_t>(order_[i]);
        if (!rods_[rod].isMost || !isTaut_[rod] || !(impulse_[i] < 0.0)) continue;
        isTaut_[rod] = false;
        isAny = true;
    }
    return isAny;
}

bool Rods::projectPositions(const Moment& moment) {
    layOut();
    findTaut(moment, true);
    for (int pass = 0; pass < mostPasses; ++pass) {
        bool isMet = true;
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
            const dvec3 d = between(rod, moment.x);
            const double g =
                !mayPull(order_[i]) ? 0.0 : (glm::dot(d, d) - rod.length * rod.length) / (2.0 * rod.length);
            const double size = norm(rod.a.of(moment.x)) + norm(rod.b.of(moment.x));
            isMet = isMet && std::abs(g) <= relativeTolerance * rod.length + roundingShare * size;
            impulse_[i] = g;
        }
        if (isMet) return pass > 0;
        if (pass == 0 || pass >= oldPasses) factor(pass == 0 ? moment.from : moment.x, moment.inverseMass);
        matrix_.solve(std::span(impulse_));
        if (pass == 0 && slacken()) {
            pass = -1;
            continue;
        }
        pull(moment.x, moment);
    }
    return true;
}

bool Rods::projectVelocities(const Moment& moment) {
    layOut();
    findTaut(moment, false);
    do {
        factor(moment.x, moment.inverseMass);
        bool isMet = true;
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
            impulse_[i] = glm::dot(direction_[i], between(rod, moment.v));
            const double size = norm(rod.a.of(moment.v)) + norm(rod.b.of(moment.v));
            isMet = isMet && std::abs(impulse_[i]) <= roundingShare * size;
        }
        if (isMet) return false;
        matrix_.solve(std::span(impulse_));
    } while (slacken());
    pull(moment.v, moment);
    return true;
}

}  // namespace taut::world
