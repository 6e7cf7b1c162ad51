#include "taut/contact/solver.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr double fastestOut = 1.0;        // [m/s] limit of the position correction
constexpr std::size_t parallelRows = 64;  // fewer rows are solved on one thread, which is faster
constexpr double settled = 1e-6;          // sweeps end when changes are below this share of the thickness per instant

// Velocity, or way, of the first side relative to the second.
dvec3 relative(const ContactConstraint& pair, std::span<const dvec3> u) {
    dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(k);
        if (pair.points[i] >= 0) sum += pair.weights[i] * u[static_cast<std::size_t>(pair.points[i])];
    }
    return sum;
}

void apply(const ContactConstraint& pair, const std::array<double, 4>& gains, const dvec3& impulse,
           std::span<dvec3> u) {
    for (std::size_t i = 0; i < 4; ++i) u[static_cast<std::size_t>(pair.points[i])] += gains[i] * impulse;
}

// Keeps the shift of a point from leading into its collider. sum [m]: what this has added along the normal so far.
void keepOut(const KinematicContact& contact, std::span<dvec3> shift, double& sum) {
    dvec3& own = shift[static_cast<std::size_t>(contact.point)];
    const double wanted = std::max(0.0, sum - glm::dot(own, contact.normal));
    own += (wanted - sum) * contact.normal;
    sum = wanted;
}

// [m/s] The speed at which a pair has to part. 0: the pair may come to rest.
double reboundOf(const ContactConstraint& pair, const SolverOptions& options, std::span<const dvec3> u) {
    const double closing = -glm::dot(pair.normal, relative(pair, u));
    return closing > options.restSpeed ? options.restitution * closing : 0.0;
}

// Whether nothing moves the point. Such a point passes no impulse on, and does not join its pairs to one cluster.
bool isFixed(int point, std::span<const double> inverseMass) {
    return !(inverseMass[static_cast<std::size_t>(point)] > 0);
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

// Union-find over the points of pairs -> parent_, touched_. The root of a cluster is its lowest point.
void ContactSolver::joinPoints(std::span<const ContactConstraint> pairs, std::size_t pointCount,
                               std::span<const double> inverseMass) {
    if (parent_.size() != pointCount)
        parent_.assign(pointCount, -1);
    else
        for (int i : touched_) parent_[static_cast<std::size_t>(i)] = -1;
    for (const ContactConstraint& pair : pairs) {
        int first = -1;
        for (int i : pair.points) {
            if (parent_[static_cast<std::size_t>(i)] < 0) parent_[static_cast<std::size_t>(i)] = i;
            if (isFixed(i, inverseMass)) continue;
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
}

// Sorts the pairs and the contacts with colliders by cluster -> rows_, kinematicRows_, clusterStart_, kinematicStart_.
void ContactSolver::findClusters(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
                                 std::size_t pointCount, std::span<const double> inverseMass) {
    joinPoints(pairs, pointCount, inverseMass);

    // The cluster of each pair and of each contact with a collider. Sorting keeps their order within a cluster.
    std::vector<std::pair<int, int>> order;  // cluster, pair
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        int cluster = -1;
        for (int i : pairs[p].points)
            if (!isFixed(i, inverseMass)) cluster = root(i);
        if (cluster >= 0) order.emplace_back(cluster, static_cast<int>(p));
    }
    std::sort(order.begin(), order.end());
    std::vector<std::pair<int, std::size_t>> supports;  // cluster, contact with a collider
    for (std::size_t k = 0; k < kinematic.size(); ++k) {
        const int i = kinematic[k].point;
        if (parent_[static_cast<std::size_t>(i)] >= 0 && !isFixed(i, inverseMass)) supports.emplace_back(root(i), k);
    }
    std::sort(supports.begin(), supports.end());

    // One row for each. A cluster starts where the number changes, and takes the contacts with the same number.
    rows_.clear();
    clusterStart_.clear();
    kinematicRows_.clear();
    kinematicStart_.clear();
    std::size_t next = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || order[k].first != order[k - 1].first) {
            clusterStart_.push_back(k);
            kinematicStart_.push_back(kinematicRows_.size());
            for (; next < supports.size() && supports[next].first <= order[k].first; ++next) {
                if (supports[next].first != order[k].first) continue;
                const KinematicContact& own = kinematic[supports[next].second];
                kinematicRows_.push_back({own, 1.0 / inverseMass[static_cast<std::size_t>(own.point)]});
            }
        }
        rows_.push_back({order[k].second});
    }
    clusterStart_.push_back(rows_.size());
    kinematicStart_.push_back(kinematicRows_.size());
}

// Sets the effective mass, gains, gap speed and rebound of each row.
void ContactSolver::prepareRows(std::span<const ContactConstraint> pairs, std::span<const double> inverseMass, double h,
                                const SolverOptions& options, std::span<const dvec3> u) {
    for (Row& row : rows_) {
        const ContactConstraint& pair = pairs[static_cast<std::size_t>(row.pair)];
        double inverse = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double own = inverseMass[static_cast<std::size_t>(pair.points[i])];
            inverse += pair.weights[i] * pair.weights[i] * own;
            row.gains[i] = pair.weights[i] * own;
            row.largestGain = std::max(row.largestGain, std::abs(row.gains[i]));
        }
        row.mass = 1.0 / inverse;
        row.gapSpeed = std::max(pair.gap(), 0.0) / h;
        row.rebound = reboundOf(pair, options, u);
        if (row.rebound > 0) row.gapSpeed = 0;
    }
}

ContactSolver::Cluster ContactSolver::clusterAt(std::size_t k, std::span<const ContactConstraint> pairs, double h) {
    const std::span<Row> rows(rows_.data() + clusterStart_[k], clusterStart_[k + 1] - clusterStart_[k]);
    const std::span<KinematicRow> kinematicRows(kinematicRows_.data() + kinematicStart_[k],
                                                kinematicStart_[k + 1] - kinematicStart_[k]);
    double thickness = 1e300;
    for (const Row& row : rows) thickness = std::min(thickness, pairs[static_cast<std::size_t>(row.pair)].thickness);
    return {rows, kinematicRows, settled * thickness / h};
}

// Solves 0 <= multiplier  ⊥  n·shift - target >= 0 by Gauss-Seidel, for the pairs that overlap or have an impulse.
// Pairs that do not overlap have the target 0, so that a correction does not press them together.
void ContactSolver::correctPositions(const Cluster& cluster, std::span<const ContactConstraint> pairs, double h,
                                     const SolverOptions& options, std::span<dvec3> shift) const {
    std::vector<PositionRow> rows;
    bool overlaps = false;
    for (const Row& row : cluster.rows) {
        const ContactConstraint& pair = pairs[static_cast<std::size_t>(row.pair)];
        const double target =
            pair.gap() < 0 ? std::min(-options.recovery * pair.recovery * pair.gap(), fastestOut * h) : 0.0;
        overlaps = overlaps || target > 0;
        if (target > 0 || row.impulse.normal > 0) rows.push_back({row.pair, row.gains, row.mass, target});
    }
    if (!overlaps) return;

    std::vector<double> sums(cluster.kinematicRows.size(), 0.0);
    for (int sweep = 1;; ++sweep) {
        double largest = 0;  // [m/s]
        for (PositionRow& row : rows) {
            const ContactConstraint& pair = pairs[static_cast<std::size_t>(row.pair)];
            const double along = glm::dot(pair.normal, relative(pair, shift));
            const double wanted = std::max(0.0, row.multiplier + row.mass * (row.target - along));
            const double change = wanted - row.multiplier;
            row.multiplier = wanted;
            apply(pair, row.gains, change * pair.normal, shift);
            largest = std::max(largest, std::abs(change) / row.mass / h);
        }
        for (std::size_t i = 0; i < sums.size(); ++i) keepOut(cluster.kinematicRows[i].contact, shift, sums[i]);
        if (largest < cluster.tolerance || sweep >= options.sweeps) return;
    }
}

// Solves u, then v and the position correction. Both need the impulses of u, but not each other. Returns the number of
// sweeps for u.
int ContactSolver::solveCluster(const Cluster& cluster, std::span<const ContactConstraint> pairs, double h,
                                const SolverOptions& options, std::span<dvec3> u, std::span<dvec3> v,
                                std::span<dvec3> shift) {
    const int sweeps =
        projectedGaussSeidel(pairs, cluster.rows, cluster.kinematicRows, options.sweeps, cluster.tolerance, u);
    for (const Row& row : cluster.rows) {
        impulses_[static_cast<std::size_t>(row.pair)] = row.impulse.normal;
        frictions_[static_cast<std::size_t>(row.pair)] = row.impulse.friction;
    }

    const auto solveV = [&] {
        std::vector<Row> rows;
        for (const Row& row : cluster.rows)
            if (row.impulse.normal > 0) {
                rows.push_back(row);
                rows.back().rebound = reboundOf(pairs[static_cast<std::size_t>(row.pair)], options, v);
            }
        std::vector<KinematicRow> kinematicRows(cluster.kinematicRows.begin(), cluster.kinematicRows.end());
        projectedGaussSeidel(pairs, rows, kinematicRows, options.sweeps, cluster.tolerance, v);
    };
    const auto correct = [&] { correctPositions(cluster, pairs, h, options, shift); };
    if (cluster.rows.size() < parallelRows) {
        correct();
        solveV();
    } else {
        core::parallelFor(
            2, [&](int which) { which == 0 ? correct() : solveV(); });
    }
    return sweeps;
}

void ContactSolver::solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
                          std::span<const double> inverseMass, double h, const SolverOptions& options,
                          std::span<dvec3> u, std::span<dvec3> v, std::span<dvec3> shift) {
    impulses_.assign(pairs.size(), 0.0);
    frictions_.assign(pairs.size(), dvec3(0.0));
    findClusters(pairs, kinematic, u.size(), inverseMass);
    prepareRows(pairs, inverseMass, h, options, u);

    // No two clusters share a movable point, so they can be solved in parallel.
    const int count = clusters();
    std::vector<int> sweeps(static_cast<std::size_t>(count), 0);
    const auto solveOne = [&](int c) {
        const auto k = static_cast<std::size_t>(c);
        sweeps[k] = solveCluster(clusterAt(k, pairs, h), pairs, h, options, u, v, shift);
    };
    if (rows_.size() < parallelRows)
        for (int c = 0; c < count; ++c) solveOne(c);
    else
        core::parallelFor(count, solveOne);

    mostSweeps_ = 0;
    for (int own : sweeps) mostSweeps_ = std::max(mostSweeps_, own);
}

}  // namespace taut::contact
