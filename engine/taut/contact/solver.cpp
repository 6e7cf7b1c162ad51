#include "taut/contact/solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

constexpr double fastestOut = 1.0;         // [m/s] limit of the position correction
constexpr std::size_t parallelRows = 64;   // fewer rows are solved on one thread, which is faster
constexpr std::size_t colouredPairs = 64;  // clusters with fewer keep the order of their pairs
constexpr int mostColours = 64;

Four four(const dvec3& v) {
    return {{v.x, v.y, v.z, 0}};
}
dvec3 vectorOf(const Four& v) {
    return {v.of[0], v.of[1], v.of[2]};
}

// [m/s] The speed at which a pair has to part. 0: the pair may come to rest.
double reboundOf(const Row& row, const SolverOptions& options, std::span<const Four> velocities) {
    dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k)
        sum += row.weights[k] * vectorOf(velocities[static_cast<std::size_t>(row.slots[k])]);
    const double closing = -glm::dot(vectorOf(row.normal), sum);
    return closing > options.restSpeed ? options.restitution * closing : 0.0;
}

// Of the same contact in every instant.
std::uint64_t keyOf(const ContactConstraint& pair) {
    return (pair.isPoint ? std::uint64_t{1} : std::uint64_t{2}) << 62U | static_cast<std::uint64_t>(pair.a) << 31U |
           static_cast<std::uint64_t>(pair.b);
}
// The number is that among the contacts of its point.
std::uint64_t keyOf(const KinematicContact& contact, int number) {
    return static_cast<std::uint64_t>(contact.point) << 31U | static_cast<std::uint64_t>(number);
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

// Union-find over the points of pairs -> parent_, touched_. The root of a cluster is its lowest point. A fixed point
// does not join its pairs to one cluster.
void ContactSolver::joinPoints(const Problem& problem) {
    const std::size_t pointCount = problem.u.size();
    if (parent_.size() != pointCount)
        parent_.assign(pointCount, -1);
    else
        for (int i : touched_) parent_[static_cast<std::size_t>(i)] = -1;
    for (const ContactConstraint& pair : problem.pairs) {
        int first = -1;
        for (int i : pair.points) {
            if (parent_[static_cast<std::size_t>(i)] < 0) parent_[static_cast<std::size_t>(i)] = i;
            if (problem.isFixed(i)) continue;
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

// Sorts the sources by cluster, and makes their rows -> rows_, clusters_, slots_, u_, v_, shift_.
void ContactSolver::findClusters(const Problem& problem) {
    joinPoints(problem);
    slots_.resize(problem.u.size());
    u_.clear();
    v_.clear();
    for (int i : touched_) {
        if (problem.isFixed(i)) continue;
        const auto k = static_cast<std::size_t>(i);
        slots_[k] = addSlot(problem.u[k], problem.v[k]);
    }

    const int pairCount = static_cast<int>(problem.pairs.size());
    order_.clear();
    for (int p = 0; p < pairCount; ++p)
        for (int i : problem.pairs[static_cast<std::size_t>(p)].points)
            if (!problem.isFixed(i)) {
                order_.emplace_back(root(i), p);
                break;
            }
    for (std::size_t k = 0; k < problem.kinematic.size(); ++k) {
        const int i = problem.kinematic[k].point;
        if (parent_[static_cast<std::size_t>(i)] >= 0 && !problem.isFixed(i))
            order_.emplace_back(root(i), pairCount + static_cast<int>(k));
    }
    std::sort(order_.begin(), order_.end());

    rows_.clear();
    keys_.clear();
    clusters_.clear();
    std::vector<int> sources;
    for (std::size_t k = 0; k < order_.size();) {
        Cluster cluster{rows_.size(), 0, 1e300};
        sources.clear();
        std::size_t next = k;
        for (; next < order_.size() && order_[next].first == order_[k].first; ++next) {
            const int source = order_[next].second;
            sources.push_back(source);
            if (source < pairCount)
                cluster.tolerance =
                    std::min(cluster.tolerance, problem.pairs[static_cast<std::size_t>(source)].thickness);
        }
        cluster.tolerance *= problem.options.settled / problem.h;
        colour(sources, problem);
        for (int source : sources) addRow(source, problem);
        cluster.last = rows_.size();
        clusters_.push_back(cluster);
        k = next;
    }
    shift_.assign(u_.size(), Four{});
}

// Sorts the pairs of a large cluster by colour. A pair gets the first colour that none of its points has yet.
void ContactSolver::colour(std::span<int> sources, const Problem& problem) {
    const auto pairs = static_cast<std::size_t>(
        std::lower_bound(sources.begin(), sources.end(), static_cast<int>(problem.pairs.size())) - sources.begin());
    if (pairs < colouredPairs) return;
    taken_.assign(problem.u.size(), 0);
    std::array<std::vector<int>, mostColours> colours;
    for (int source : sources.first(pairs)) {
        std::uint64_t used = 0;
        const std::array<int, 4>& points = problem.pairs[static_cast<std::size_t>(source)].points;
        for (int i : points)
            if (!problem.isFixed(i)) used |= taken_[static_cast<std::size_t>(i)];
        const int free = std::min(std::countr_one(used), mostColours - 1);  // the last one may share points
        colours[static_cast<std::size_t>(free)].push_back(source);
        for (int i : points) taken_[static_cast<std::size_t>(i)] |= std::uint64_t{1} << static_cast<unsigned>(free);
    }
    auto to = sources.begin();
    for (const std::vector<int>& own : colours) to = std::copy(own.begin(), own.end(), to);
}

int ContactSolver::addSlot(const dvec3& u, const dvec3& v) {
    u_.push_back(four(u));
    v_.push_back(four(v));
    return static_cast<int>(u_.size()) - 1;
}

int ContactSolver::slotOf(int point, const Problem& problem) {
    const auto k = static_cast<std::size_t>(point);
    return problem.isFixed(point) ? addSlot(problem.u[k], problem.v[k]) : slots_[k];
}

// Appends the row of a pair, or of a contact with a collider. It starts with what it had in the last instant.
void ContactSolver::addRow(int source, const Problem& problem) {
    Row& row = rows_.emplace_back();
    row.source = source;
    const std::size_t pairCount = problem.pairs.size();
    std::uint64_t key;
    if (const auto own = static_cast<std::size_t>(source); own < pairCount) {
        const ContactConstraint& pair = problem.pairs[own];
        key = keyOf(pair);
        row.normal = four(pair.normal);
        row.friction = pair.friction;
        double inverse = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double inverseMass = problem.inverseMass[static_cast<std::size_t>(pair.points[i])];
            inverse += pair.weights[i] * pair.weights[i] * inverseMass;
            row.weights[i] = pair.weights[i];
            row.gains[i] = pair.weights[i] * inverseMass;
            row.largestGain = std::max(row.largestGain, std::abs(row.gains[i]));
            row.slots[i] = slotOf(pair.points[i], problem);
        }
        row.softness = pair.softness * inverse;
        row.mass = 1.0 / (inverse + row.softness);
        const double rebound = reboundOf(row, problem.options, u_);
        row.closing = rebound > 0 ? -rebound : std::max(pair.gap(), 0.0) / problem.h;
    } else {
        const std::size_t k = own - pairCount;
        const KinematicContact& contact = problem.kinematic[k];
        int number = 0;
        while (static_cast<std::size_t>(number) < k &&
               problem.kinematic[k - static_cast<std::size_t>(number) - 1].point == contact.point)
            ++number;
        key = keyOf(contact, number);
        row.normal = four(contact.normal);
        row.friction = contact.friction;
        row.weights[0] = 1;
        row.weights[1] = -1;
        row.gains[0] = row.largestGain = problem.inverseMass[static_cast<std::size_t>(contact.point)];
        row.mass = 1.0 / row.gains[0];
        row.closing = glm::dot(contact.normal, contact.carried) - contact.speed;
        row.slots[0] = slotOf(contact.point, problem);
        row.slots[1] = row.slots[2] = row.slots[3] = addSlot(contact.carried, contact.carried);
    }

    keys_.push_back(key);
    const auto last = std::lower_bound(last_.begin(), last_.end(), key,
                                       [](const LastImpulse& l, std::uint64_t wanted) { return l.key < wanted; });
    if (last == last_.end() || last->key != key) return;
    // Friction turns with the plane of the contact.
    const dvec3 normal = vectorOf(row.normal);
    dvec3 friction = vectorOf(last->impulse);
    friction -= glm::dot(friction, normal) * normal;
    const double limit = row.friction * last->impulse.of[3], size = std::sqrt(glm::dot(friction, friction));
    if (size > limit) friction *= limit / size;
    row.impulse = {{friction.x, friction.y, friction.z, last->impulse.of[3]}};
}

// Solves v by the same rule, for the rows that got an impulse.
void ContactSolver::solveStored(std::span<const Row> all, const Cluster& cluster, const Problem& problem) {
    thread_local std::vector<Row> rows;
    rows.clear();
    for (const Row& row : all) {
        const bool isPair = static_cast<std::size_t>(row.source) < problem.pairs.size();
        if (isPair && !(row.impulse.of[3] > 0)) continue;
        Row& own = rows.emplace_back(row);
        if (isPair) own.closing = std::max(own.closing, 0.0) - reboundOf(own, problem.options, v_);
    }
    projectedGaussSeidel(rows, problem.options.sweeps, cluster.tolerance, v_);
}

// Solves 0 <= multiplier  ⊥  n·shift - target >= 0, for the pairs that overlap or have an impulse. Pairs that do not
// overlap have the target 0, so that a correction does not press them together, nor into colliders.
void ContactSolver::correctPositions(std::span<const Row> all, const Cluster& cluster, const Problem& problem) {
    thread_local std::vector<Row> rows;
    rows.clear();
    bool overlaps = false;
    for (const Row& row : all) {
        double target = 0;
        if (const auto source = static_cast<std::size_t>(row.source); source < problem.pairs.size()) {
            const ContactConstraint& pair = problem.pairs[source];
            if (pair.gap() < 0)
                target = std::min(-problem.options.recovery * pair.recovery * pair.gap(), fastestOut * problem.h);
            if (!(target > 0) && !(row.impulse.of[3] > 0)) continue;
        }
        overlaps = overlaps || target > 0;
        Row& own = rows.emplace_back(row);
        own.impulse = {};
        own.friction = 0;
        own.closing = -target;
    }
    if (overlaps) projectedGaussSeidel(rows, problem.options.sweeps, cluster.tolerance * problem.h, shift_);
}

// Solves u, then v and the position correction. Both need the impulses of u, but not each other. Returns the number of
// sweeps for u.
int ContactSolver::solveCluster(const Cluster& cluster, const Problem& problem) {
    const std::span<Row> rows(rows_.data() + cluster.first, cluster.last - cluster.first);
    const int sweeps = projectedGaussSeidel(rows, problem.options.sweeps, cluster.tolerance, u_);
    if (rows.size() < parallelRows) {
        correctPositions(rows, cluster, problem);
        solveStored(rows, cluster, problem);
    } else {
        core::parallelFor(2, [&](int which) {
            which == 0 ? correctPositions(rows, cluster, problem) : solveStored(rows, cluster, problem);
        });
    }
    return sweeps;
}

// Keeps the impulses for the next instant -> last_, impulses_.
void ContactSolver::remember(std::size_t pairCount) {
    last_.clear();
    impulses_.assign(pairCount, 0.0);
    frictions_.assign(pairCount, dvec3(0.0));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const Row& row = rows_[r];
        if (!(row.impulse.of[3] > 0)) continue;
        last_.push_back({keys_[r], row.impulse});
        const auto source = static_cast<std::size_t>(row.source);
        if (source >= pairCount) continue;
        impulses_[source] = row.impulse.of[3];
        frictions_[source] = vectorOf(row.impulse);
    }
    std::sort(last_.begin(), last_.end(), [](const LastImpulse& a, const LastImpulse& b) { return a.key < b.key; });
}

void ContactSolver::solve(std::span<const ContactConstraint> pairs, std::span<const KinematicContact> kinematic,
                          std::span<const double> inverseMass, double h, const SolverOptions& options,
                          std::span<dvec3> u, std::span<dvec3> v, std::span<dvec3> shift) {
    const Problem problem{pairs, kinematic, inverseMass, h, options, u, v, shift};
    findClusters(problem);

    // No two clusters share a slot, so they can be solved in parallel.
    const int count = clusters();
    std::vector<int> sweeps(static_cast<std::size_t>(count), 0);
    const auto solveOne = [&](int c) {
        const auto k = static_cast<std::size_t>(c);
        sweeps[k] = solveCluster(clusters_[k], problem);
    };
    if (rows_.size() < parallelRows)
        for (int c = 0; c < count; ++c) solveOne(c);
    else
        core::parallelFor(count, solveOne);

    mostSweeps_ = 0;
    for (int own : sweeps) mostSweeps_ = std::max(mostSweeps_, own);
    for (int i : touched_) {
        if (problem.isFixed(i)) continue;
        const auto k = static_cast<std::size_t>(i), slot = static_cast<std::size_t>(slots_[k]);
        u[k] = vectorOf(u_[slot]);
        v[k] = vectorOf(v_[slot]);
        shift[k] = vectorOf(shift_[slot]);
    }
    remember(pairs.size());
}

}  // namespace taut::contact
