#include "taut/contact/solver.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/parallel.h"

namespace taut::contact {
namespace {

constexpr double fastestOut = 1.0;  // [m/s] that it is taken back with
constexpr std::size_t shared = 64;  // rows; fewer are solved sooner than they are shared out
constexpr double settled = 1e-6;    // of the distance kept, an instant: smaller changes end the sweeps

dvec3 between(const ContactConstraint& pair, std::span<const dvec3> u) {
    dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (pair.points[i] >= 0) sum += pair.weights[i] * u[static_cast<std::size_t>(pair.points[i])];
    }
    return sum;
}

void press(const ContactConstraint& pair, const std::array<double, 4>& gains, const dvec3& impulse,
           std::span<dvec3> u) {
    for (std::size_t i = 0; i < 4; ++i) u[static_cast<std::size_t>(pair.points[i])] += gains[i] * impulse;
}

// A point that is held does not go further into what holds it: way is how far [m] it was kept from that so far.
void hold(const KinematicContact& held, std::span<dvec3> shift, double& way) {
    dvec3& own = shift[static_cast<std::size_t>(held.point)];
    const double wanted = std::max(0.0, way - glm::dot(own, held.normal));
    own += (wanted - way) * held.normal;
    way = wanted;
}

// Calls until it says that it is settled. Returns how often.
template <class Once>
int sweep(int atMost, Once&& once) {
    int sweeps = 1;
    while (!once() && sweeps < atMost) ++sweeps;
    return sweeps;
}

}  // namespace

int ContactSolver::root(int point) {
    while (parent_[static_cast<std::size_t>(point)] != point) {
        int& up = parent_[static_cast<std::size_t>(point)];
        up = parent_[static_cast<std::size_t>(up)];
        point = up;
    }
    return point;
}

void ContactSolver::findClusters(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> held,
                                 std::size_t pointCount, std::span<const double> inverseMass) {
    if (parent_.size() != pointCount)
        parent_.assign(pointCount, -1);
    else
        for (int i : touched_) parent_[static_cast<std::size_t>(i)] = -1;
    const auto join = [&](int i) {
        if (parent_[static_cast<std::size_t>(i)] >= 0) return;
        parent_[static_cast<std::size_t>(i)] = i;
    };
    // Points that nothing moves pass nothing on.
    const auto isFixed = [&](int i) { return !(inverseMass[static_cast<std::size_t>(i)] > 0); };
    for (const ContactConstraint& pair : pairs) {
        int first = -1;
        for (int i : pair.points) {
            join(i);
            if (isFixed(i)) continue;
            const int own = root(i);
            if (first < 0) {
                first = own;
                continue;
            }
            const int low = std::min(first, own);
            parent_[static_cast<std::size_t>(std::max(first, own))] = low;
            first = low;
        }
    }
    touched_.clear();
    for (std::size_t i = 0; i < pointCount; ++i)
        if (parent_[i] >= 0) touched_.push_back(static_cast<int>(i));

    std::vector<std::pair<int, int>> order;  // cluster, pair
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        int cluster = -1;
        for (int i : pairs[p].points)
            if (!isFixed(i)) cluster = root(i);
        if (cluster >= 0) order.emplace_back(cluster, static_cast<int>(p));
    }
    std::sort(order.begin(), order.end());
    rows_.clear();
    clusterStart_.clear();
    kinematicRows_.clear();
    kinematicStart_.clear();
    std::vector<std::pair<int, std::size_t>> holds;
    for (std::size_t h = 0; h < held.size(); ++h) {
        const int i = held[h].point;
        if (parent_[static_cast<std::size_t>(i)] >= 0 && !isFixed(i)) holds.emplace_back(root(i), h);
    }
    std::sort(holds.begin(), holds.end());
    std::size_t next = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || order[k].first != order[k - 1].first) {
            clusterStart_.push_back(k);
            kinematicStart_.push_back(kinematicRows_.size());
            for (; next < holds.size() && holds[next].first <= order[k].first; ++next)
                if (holds[next].first == order[k].first) {
                    const KinematicContact& own = held[holds[next].second];
                    kinematicRows_.push_back({own, 1.0 / inverseMass[static_cast<std::size_t>(own.point)]});
                }
        }
        rows_.push_back({order[k].second});
    }
    clusterStart_.push_back(rows_.size());
    kinematicStart_.push_back(kinematicRows_.size());
}

// Of a cluster, by a shift: of pairs that overlap or press.
void ContactSolver::takeBack(std::span<const ContactConstraint> pairs, std::span<const Row> rows,
                             std::span<const KinematicRow> kinematicRows, double h, const SolverOptions& options,
                             double little, std::span<dvec3> shift) const {
    std::vector<Push> pushes;
    bool overlaps = false;
    for (const Row& row : rows) {
        const ContactConstraint& pair = pairs[static_cast<std::size_t>(row.pair)];
        const double recover = pair.gap() < 0 ? std::min(-options.recovery * pair.recovery * pair.gap(), fastestOut * h) : 0.0;
        overlaps = overlaps || recover > 0;
        if (recover > 0 || row.impulse.normal > 0) pushes.push_back({row.pair, row.gains, row.mass, recover});
    }
    if (!overlaps) return;
    std::vector<double> held(kinematicRows.size(), 0.0);
    sweep(options.sweeps, [&] {
        double most = 0;
        for (Push& push : pushes) {
            const ContactConstraint& pair = pairs[static_cast<std::size_t>(push.pair)];
            const double along = glm::dot(pair.normal, between(pair, shift));
            const double wanted = std::max(0.0, push.way + push.mass * (push.recover - along));
            const double change = wanted - push.way;
            push.way = wanted;
            press(pair, push.gains, change * pair.normal, shift);
            most = std::max(most, std::abs(change) / push.mass / h);
        }
        for (std::size_t i = 0; i < kinematicRows.size(); ++i) hold(kinematicRows[i].held, shift, held[i]);
        return most < little;
    });
}

void ContactSolver::solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> held,
                          std::span<const double> inverseMass, double h, const SolverOptions& options,
                          std::span<dvec3> u, std::span<dvec3> v, std::span<dvec3> shift) {
    impulses_.assign(pairs.size(), 0.0);
    findClusters(pairs, held, u.size(), inverseMass);
    const auto bounceOf = [&](const ContactConstraint& pair, std::span<const dvec3> velocities) {
        const double arrival = -glm::dot(pair.normal, between(pair, velocities));
        return arrival > options.restSpeed ? options.restitution * arrival : 0.0;
    };
    for (Row& row : rows_) {
        const ContactConstraint& pair = pairs[static_cast<std::size_t>(row.pair)];
        double inverse = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double own = inverseMass[static_cast<std::size_t>(pair.points[i])];
            inverse += pair.weights[i] * pair.weights[i] * own;
            row.gains[i] = pair.weights[i] * own;
            row.most = std::max(row.most, std::abs(row.gains[i]));
        }
        row.mass = 1.0 / inverse;
        row.open = std::max(pair.gap(), 0.0) / h;
        row.bounce = bounceOf(pair, u);
        if (row.bounce > 0) row.open = 0;
    }
    const int count = clusters();
    std::vector<int> sweepsOf(static_cast<std::size_t>(count), 0);
    const auto solveCluster = [&](int c) {
        const auto k = static_cast<std::size_t>(c);
        const std::span<Row> rows(rows_.data() + clusterStart_[k], clusterStart_[k + 1] - clusterStart_[k]);
        const std::span<KinematicRow> kinematicRows(kinematicRows_.data() + kinematicStart_[k],
                                                    kinematicStart_[k + 1] - kinematicStart_[k]);
        double thickness = 1e300;
        for (const Row& row : rows)
            thickness = std::min(thickness, pairs[static_cast<std::size_t>(row.pair)].thickness);
        const double little = settled * thickness / h;
        sweepsOf[k] = projectedGaussSeidel(pairs, rows, kinematicRows, options.sweeps, little, u);
        for (const Row& row : rows) impulses_[static_cast<std::size_t>(row.pair)] = row.impulse.normal;
        const auto pressV = [&] {
            std::vector<Row> pressing;
            for (const Row& row : rows)
                if (row.impulse.normal > 0) {
                    pressing.push_back(row);
                    pressing.back().bounce = bounceOf(pairs[static_cast<std::size_t>(row.pair)], v);
                }
            std::vector<KinematicRow> holding(kinematicRows.begin(), kinematicRows.end());
            projectedGaussSeidel(pairs, pressing, holding, options.sweeps, little, v);
        };
        const auto recover = [&] { takeBack(pairs, rows, kinematicRows, h, options, little, shift); };
        if (rows.size() < shared) {
            recover();
            pressV();
        } else {
            core::parallelFor(2, [&](int which) { which == 0 ? recover() : pressV(); });
        }
    };
    if (rows_.size() < shared)
        for (int c = 0; c < count; ++c) solveCluster(c);
    else
        core::parallelFor(count, solveCluster);
    mostSweeps_ = 0;
    for (int s : sweepsOf) mostSweeps_ = std::max(mostSweeps_, s);
}

}  // namespace taut::contact
