// Rows that share movable points are one cluster; the rows of a large one are coloured.
#include <algorithm>
#include <bit>

#include "taut/contact/solver.h"

namespace taut::contact {
namespace {

constexpr std::size_t colouredPairs = 64;  // clusters with fewer keep the order of their pairs
constexpr int mostColours = 64;

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
void ContactSolver::joinPoints() {
    const std::size_t pointCount = block_.x.size();
    if (parent_.size() != pointCount)
        parent_.assign(pointCount, -1);
    else
        for (int i : touched_) parent_[static_cast<std::size_t>(i)] = -1;
    // All that move a point, with what others of its pair have come to.
    const auto join = [&](int point, int& first) {
        carried_->forEachMover(point, [&](int mover, double) {
            const int i = leaderOf(mover);
            if (parent_[static_cast<std::size_t>(i)] < 0) parent_[static_cast<std::size_t>(i)] = i;
            if (isFixed(i)) return;
            const int own = root(i);
            if (first < 0) {
                first = own;
                return;
            }
            const int low = std::min(first, own);
            parent_[static_cast<std::size_t>(std::max(first, own))] = low;
            first = low;
        });
    };
    for (const ContactConstraint& pair : block_.pairs) {
        int first = -1;
        for (int point : pair.points) join(point, first);
    }
    for (const KinematicContact& contact : block_.kinematic) {
        int first = -1;
        if (contact.isWhole) contact.forEachPoint([&](int point, double) { join(point, first); });
    }
    for (const Solid& solid : solids_)
        if (const int leader = solid.points.front(); solid.moves && parent_[static_cast<std::size_t>(leader)] >= 0)
            for (int i : solid.points) parent_[static_cast<std::size_t>(i)] = root(leader);
    touched_.clear();
    for (std::size_t i = 0; i < pointCount; ++i)
        if (parent_[i] >= 0) touched_.push_back(static_cast<int>(i));
}

// Sorts the sources by cluster, and makes their rows -> rows_, clusters_, slots_.
void ContactSolver::findClusters() {
    joinPoints();
    slots_.resize(block_.x.size());
    u_.clear();
    moving_.clear();
    fixed_.clear();
    driven_.clear();
    for (int i : touched_) {
        if (isFixed(i) || solidOf(i) != nullptr) continue;
        const int slot = slots_[static_cast<std::size_t>(i)] = addSlot();
        moving_.emplace_back(slot, i);
    }
    takeSolids();

    const int pairCount = static_cast<int>(block_.pairs.size());
    order_.clear();
    // By what moves one of the points; nothing may.
    const auto addSource = [&](std::span<const int> points, int source) {
        int mover = -1;
        for (int point : points)
            carried_->forEachMover(point, [&](int i, double) {
                if (mover < 0 && parent_[static_cast<std::size_t>(i)] >= 0 && !isFixed(i)) mover = i;
            });
        if (mover >= 0) order_.emplace_back(root(mover), source);
    };
    for (int p = 0; p < pairCount; ++p) addSource(block_.pairs[static_cast<std::size_t>(p)].points, p);
    for (std::size_t k = 0; k < block_.kinematic.size(); ++k)
        addSource(block_.kinematic[k].used(), pairCount + static_cast<int>(k));
    std::sort(order_.begin(), order_.end());

    rows_.clear();
    turns_.clear();
    shares_.clear();
    rolls_.clear();
    keys_.clear();
    gaps_.clear();
    bases_.clear();
    clusters_.clear();
    std::vector<int> sources, roots;
    for (std::size_t k = 0; k < order_.size();) {
        Cluster cluster{rows_.size(), 0, 1e300, {}, {}};
        sources.clear();
        std::size_t next = k;
        bool hasContacts = false;
        for (; next < order_.size() && order_[next].first == order_[k].first; ++next) {
            const int source = order_[next].second;
            sources.push_back(source);
            const bool isJoint = source < pairCount && block_.pairs[static_cast<std::size_t>(source)].kind !=
                                                           ContactConstraint::Kind::contact;
            (isJoint ? cluster.hasJoints : hasContacts) = true;
            const double thickness = source < pairCount
                                         ? block_.pairs[static_cast<std::size_t>(source)].thickness
                                         : block_.kinematic[static_cast<std::size_t>(source - pairCount)].thickness;
            if (thickness > 0) cluster.tolerance = std::min(cluster.tolerance, thickness);
        }
        if (!hasContacts) {  // joints hold by themselves
            k = next;
            continue;
        }
        cluster.tolerance *= block_.options.settled / block_.h;
        colour(sources);
        for (int source : sources) addRow(source);
        cluster.last = rows_.size();
        clusters_.push_back(std::move(cluster));
        roots.push_back(order_[k].first);
        k = next;
    }
    for (std::size_t s = 0; s < solids_.size(); ++s) {
        if (!isTouched(solids_[s])) continue;
        const auto at = std::lower_bound(roots.begin(), roots.end(), root(solids_[s].points.front()));
        if (at == roots.end() || *at != root(solids_[s].points.front())) continue;
        const core::RigidMotion& own = bodies_[s].start;
        clusters_[static_cast<std::size_t>(at - roots.begin())].solids.push_back(
            {bodies_[s].slot, own.mass, glm::inverse(own.inverseInertia)});
    }
    for (Cluster& cluster : clusters_)
        if (cluster.solids.empty()) {
            const auto number = static_cast<std::size_t>(&cluster - clusters_.data());
            while (packs_.size() <= number) packs_.emplace_back();
            cluster.packs = &packs_[number];
            cluster.packs->take(rowsOf(cluster), std::span(gaps_).subspan(cluster.first, cluster.last - cluster.first),
                                u_.size(), levers());
        }
    v_.resize(u_.size());
    gone_.assign(u_.size(), Four{});
}

// Sorts the pairs of a large cluster by colour. A pair gets the first colour that none of its points has yet.
void ContactSolver::colour(std::span<int> sources) {
    const auto pairs = static_cast<std::size_t>(
        std::lower_bound(sources.begin(), sources.end(), static_cast<int>(block_.pairs.size())) - sources.begin());
    if (pairs < colouredPairs) return;
    taken_.assign(block_.x.size(), 0);
    std::array<std::vector<int>, mostColours> colours;
    for (int source : sources.first(pairs)) {
        std::uint64_t used = 0;
        const std::array<int, 4>& points = block_.pairs[static_cast<std::size_t>(source)].points;
        for (int point : points)
            carried_->forEachMover(point, [&](int i, double) {
                if (!isFixed(i)) used |= taken_[static_cast<std::size_t>(leaderOf(i))];
            });
        const int free = std::min(std::countr_one(used), mostColours - 1);  // the last one may share points
        colours[static_cast<std::size_t>(free)].push_back(source);
        for (int point : points)
            carried_->forEachMover(point, [&](int i, double) {
                taken_[static_cast<std::size_t>(leaderOf(i))] |= std::uint64_t{1} << static_cast<unsigned>(free);
            });
    }
    auto to = sources.begin();
    for (const std::vector<int>& own : colours) to = std::copy(own.begin(), own.end(), to);
}

}  // namespace taut::contact
