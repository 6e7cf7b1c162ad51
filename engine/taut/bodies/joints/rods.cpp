#include "taut/bodies/private/joints/rods.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/core/error.h"

namespace taut::world {
namespace {

constexpr double relativeTolerance = 1e-13;  // of a length
constexpr double roundingShare = 1e-15;      // of a coordinate
constexpr double leastPivot = 1e-10;         // of the diagonal element
constexpr int oldPasses = 10;                // along the directions at the start of the step
constexpr int mostPasses = 40;               // afterwards along the present directions, as in the Gauss-Newton method

double norm(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

}  // namespace

int Rods::numberOf(int point) {
    const auto found = std::find(points_.begin(), points_.end(), point);
    if (found != points_.end()) return static_cast<int>(found - points_.begin());
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
}

// A rod that already exists is not made twice.
void Rods::tie(int a, int b, double length, const Source& source) {
    const int first = numberOf(a), second = numberOf(b);
    for (const Rod& rod : rods_)
        if ((rod.a == first && rod.b == second) || (rod.a == second && rod.b == first)) return;
    rods_.push_back({first, second, length, source});
}

void Rods::tie(int a, const Place& b, double length, const Source& source) {
    places_.push_back(b);
    rods_.push_back({numberOf(a), -static_cast<int>(places_.size()), length, source});
}

double Rods::strain(std::span<const dvec3> x, const std::vector<bool>& counts) const {
    double most = 0;
    for (int r = 0; r < size(); ++r) {
        const Rod& rod = rods_[static_cast<std::size_t>(r)];
        if (holds(r) && counts[static_cast<std::size_t>(end(rod.a))] && counts[static_cast<std::size_t>(end(rod.b))])
            most = std::max(most, std::abs(norm(between(rod, x)) - rod.length) / rod.length);
    }
    return most;
}

std::vector<Constraint::Pair> Rods::pairs(double /*t*/) {
    std::vector<Pair> all;
    for (int r = 0; r < size(); ++r) {
        const Rod& rod = rods_[static_cast<std::size_t>(r)];
        if (holds(r)) all.push_back({end(rod.a), end(rod.b), r, rod.length});
    }
    return all;
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
        for (const int number : {rod.a, rod.b}) sum[static_cast<std::size_t>(end(number))] += stiffness;
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
    std::vector<std::vector<int>> at(points_.size());  // rods at each point
    for (std::size_t r = 0; r < count; ++r)
        for (const int number : {rods_[r].a, rods_[r].b})
            if (number >= 0) at[static_cast<std::size_t>(number)].push_back(static_cast<int>(r));
    const auto neighbours = [&](int r) {
        std::vector<int> all;
        const Rod& rod = rods_[static_cast<std::size_t>(r)];
        for (const int number : {rod.a, rod.b})
            if (number >= 0)
                all.insert(all.end(), at[static_cast<std::size_t>(number)].begin(),
                           at[static_cast<std::size_t>(number)].end());
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
        const Rod& own = rods_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
        int first = i;
        for (const int number : {own.a, own.b}) {
            if (number < 0) continue;
            for (const int r : at[static_cast<std::size_t>(number)]) {
                const int j = rowOf[static_cast<std::size_t>(r)];
                if (j >= i) continue;
                const Rod& other = rods_[static_cast<std::size_t>(r)];
                couplings_.push_back({i, j, number, (own.a == number) == (other.a == number) ? 1.0 : -1.0});
                first = std::min(first, j);
            }
        }
        start_.push_back(lower_.size());
        first_.push_back(first);
        lower_.resize(lower_.size() + static_cast<std::size_t>(i - first));
    }
    inversePivot_.resize(count);
    direction_.resize(count);
    impulse_.resize(count);
}

// Factors J M⁻¹ Jᵀ with the rods' directions at x.
void Rods::factor(std::span<const dvec3> x, std::span<const double> inverseMass) {
    const int count = static_cast<int>(order_.size());
    const auto weight = [&](int number) { return inverseMass[static_cast<std::size_t>(end(number))]; };
    for (int i = 0; i < count; ++i) {
        const Rod& rod = rods_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
        const dvec3 d = between(rod, x);
        const double length = norm(d);
        const bool pulls = holds(order_[static_cast<std::size_t>(i)]) && length > 0;
        direction_[static_cast<std::size_t>(i)] = pulls ? d / length : dvec3(0.0);
    }
    std::fill(lower_.begin(), lower_.end(), 0.0);
    for (const Coupling& c : couplings_)
        at(c.i, c.j) += c.sign * weight(c.end) *
                        glm::dot(direction_[static_cast<std::size_t>(c.i)], direction_[static_cast<std::size_t>(c.j)]);
    for (int i = 0; i < count; ++i) {
        const int first = first_[static_cast<std::size_t>(i)];
        for (int j = first; j < i; ++j) {  // L D
            double sum = at(i, j);
            for (int k = std::max(first, first_[static_cast<std::size_t>(j)]); k < j; ++k) sum -= at(i, k) * at(j, k);
            at(i, j) = sum;
        }
        const Rod& rod = rods_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
        const dvec3& n = direction_[static_cast<std::size_t>(i)];
        const double diagonal = (weight(rod.a) + weight(rod.b)) * glm::dot(n, n);
        double pivot = diagonal;
        for (int j = first; j < i; ++j) {
            const double scaled = at(i, j) * inversePivot_[static_cast<std::size_t>(j)];
            pivot -= scaled * at(i, j);
            at(i, j) = scaled;
        }
        inversePivot_[static_cast<std::size_t>(i)] = pivot > leastPivot * diagonal ? 1.0 / pivot : 0.0;
    }
}

void Rods::solve() {
    const int count = static_cast<int>(order_.size());
    for (int i = 0; i < count; ++i)
        for (int j = first_[static_cast<std::size_t>(i)]; j < i; ++j)
            impulse_[static_cast<std::size_t>(i)] -= at(i, j) * impulse_[static_cast<std::size_t>(j)];
    for (int i = 0; i < count; ++i) impulse_[static_cast<std::size_t>(i)] *= inversePivot_[static_cast<std::size_t>(i)];
    for (int i = count - 1; i >= 0; --i)
        for (int j = first_[static_cast<std::size_t>(i)]; j < i; ++j)
            impulse_[static_cast<std::size_t>(j)] -= at(i, j) * impulse_[static_cast<std::size_t>(i)];
}

// A rod turns during a tick, so its pull is summed along its axis.
void Rods::pull(std::span<dvec3> to, const Moment& moment) const {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
        const auto a = static_cast<std::size_t>(end(rod.a)), b = static_cast<std::size_t>(end(rod.b));
        const dvec3 impulse = impulse_[i] * direction_[i];
        to[a] += moment.inverseMass[a] * impulse;
        to[b] -= moment.inverseMass[b] * impulse;
        moment.pull[static_cast<std::size_t>(order_[i])].x += impulse_[i];
    }
}

bool Rods::projectPositions(const Moment& moment) {
    layOut();
    for (int pass = 0; pass < mostPasses; ++pass) {
        bool isMet = true;
        for (std::size_t i = 0; i < order_.size(); ++i) {
            const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
            const dvec3 d = between(rod, moment.x);
            const double g = !holds(order_[i]) ? 0.0 : (glm::dot(d, d) - rod.length * rod.length) / (2.0 * rod.length);
            const double size = norm(moment.x[static_cast<std::size_t>(end(rod.a))]) +
                                norm(moment.x[static_cast<std::size_t>(end(rod.b))]);
            isMet = isMet && std::abs(g) <= relativeTolerance * rod.length + roundingShare * size;
            impulse_[i] = g;
        }
        if (isMet) return pass > 0;
        if (pass == 0 || pass >= oldPasses) factor(pass == 0 ? moment.from : moment.x, moment.inverseMass);
        solve();
        pull(moment.x, moment);
    }
    return true;
}

bool Rods::projectVelocities(const Moment& moment) {
    layOut();
    factor(moment.x, moment.inverseMass);
    bool isMet = true;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const Rod& rod = rods_[static_cast<std::size_t>(order_[i])];
        impulse_[i] = glm::dot(direction_[i], between(rod, moment.v));
        const double size =
            norm(moment.v[static_cast<std::size_t>(end(rod.a))]) + norm(moment.v[static_cast<std::size_t>(end(rod.b))]);
        isMet = isMet && std::abs(impulse_[i]) <= roundingShare * size;
    }
    if (isMet) return false;
    solve();
    pull(moment.v, moment);
    return true;
}

}  // namespace taut::world
