#include "taut/plan/private/pins.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/plan/island_plan.h"

namespace taut::world {
namespace {

constexpr double roundingOfPins = 1e-15;  // of a coordinate or velocity
constexpr double roundingOfRows = 1e-14;  // of the unknowns
constexpr double drawnTo = 1e-9;          // of the length at first: how exactly an open pin draws
constexpr double nearlyDrawn = 1e-6;      // of the length at first: so near to its most, velocities are drawn
constexpr int mostDraws = 20;             // open pins that share points take turns

}  // namespace

void Pins::tie(const Spot& a, const Spot& b, const Source& source) {
    const Spot first = ends_.of(a, pins_), second = ends_.of(b, pins_);
    pins_.push_back({first, second, source});
    layOut(0.0);
}

void Pins::sew(const Spot& a, const Spot& b, const Closing& closing, const Source& source) {
    const Spot first = ends_.of(a, pins_), second = ends_.of(b, pins_);
    pins_.push_back({first, second, source, closing});
    layOut(0.0);
}

double Pins::Closing::mostAt(double t) const {
    const double share = (t - start) / over, left = 1.0 - share;
    return left > 0 ? length * left * left * (1.0 + 2.0 * share) : 0.0;
}

double Pins::Closing::speedAt(double t) const {
    const double share = (t - start) / over;
    return share < 1 ? -6.0 * length / over * share * (1.0 - share) : 0.0;
}

void Pins::tie(const Spot& a, const Place& b, const Source& source) {
    const Spot first = ends_.of(a, pins_);
    pins_.push_back({first, ends_.of(b), source});
    layOut(0.0);
}

// Walks along the pins of points that hold and are closed: from each place, then from each remaining point.
void Pins::layOut(double t) {
    time_ = t;
    from_ = 0;
    until_ = HUGE_VAL;
    open_.clear();
    for (int p = 0; p < size(); ++p) {
        const Closing& closing = pins_[p].closing;
        const double end = closing.end();
        if (t < end)
            until_ = std::min(until_, end);
        else
            from_ = std::max(from_, end);
        if (t < end && holds(p) && closing.length != Closing::notBegun) open_.push_back(p);
    }
    const std::size_t count = ends_.points.size() + ends_.places.size();
    std::vector<std::vector<int>> at(count);  // pins
    std::vector<int> rows;                    // pins
    std::vector<bool> isInRow(count, false);
    for (int p = 0; p < size(); ++p) {
        const Pin& pin = pins_[p];
        if (!holds(p) || !(t >= pin.closing.end())) continue;
        if (!pin.joinsPoints()) rows.push_back(p);
        for (const Spot* end : {&pin.a, &pin.b})
            for (const Spot::Share& own : end->shares()) {
                const auto number = static_cast<std::size_t>(own.point);
                if (pin.joinsPoints())
                    at[number].push_back(p);
                else
                    isInRow[number] = true;
            }
    }
    nodes_.clear();
    clusters_.clear();
    nodeOf_.assign(count, -1);
    const auto take = [&](int number, int parent, int pin) {
        if (nodeOf_[number] >= 0) return;
        nodeOf_[number] = static_cast<int>(nodes_.size());
        nodes_.push_back({number, parent, pin});
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t root = (i + ends_.points.size()) % count;  // places first
        if (nodeOf_[root] >= 0 || (at[root].empty() && !isInRow[root])) continue;
        Cluster cluster{static_cast<int>(nodes_.size()), 0};
        take(static_cast<int>(root), -1, -1);
        for (std::size_t next = static_cast<std::size_t>(cluster.first); next < nodes_.size(); ++next)
            for (const int p : at[nodes_[next].number])
                for (const Spot* end : {&pins_[p].a, &pins_[p].b}) take(end->nearest(), static_cast<int>(next), p);
        cluster.last = static_cast<int>(nodes_.size());
        clusters_.push_back(cluster);
    }
    sum_.resize(nodes_.size());
    layOutRows(rows);
    listPairs();
}

// In the order of the pins, so that neighbours of a seam are neighbours here.
void Pins::layOutRows(std::span<const int> pins) {
    rows_.clear();
    couplings_.clear();
    matrix_ = {};
    std::vector<int> clusterOf(nodes_.size());
    for (std::size_t c = 0; c < clusters_.size(); ++c)
        std::fill(clusterOf.begin() + clusters_[c].first, clusterOf.begin() + clusters_[c].last, static_cast<int>(c));
    const auto clusterAt = [&](int number) { return clusterOf[nodeOf_[number]]; };
    std::vector<std::vector<Spot::Share>> at(clusters_.size());  // rows, and their weights
    for (const int p : pins) {
        const Pin& pin = pins_[p];
        const int row = static_cast<int>(rows_.size());
        rows_.push_back({p, TieEnds::difference(pin.a, pin.b),
                         TieEnds::difference(pin.a.renumbered(clusterAt), pin.b.renumbered(clusterAt))});
        int first = row;
        for (const auto& [cluster, weight] : rows_.back().clusters) {
            std::vector<Spot::Share>& met = at[cluster];
            met.push_back({row, weight});
            for (const auto& [other, otherWeight] : met) {
                couplings_.push_back({row, other, cluster, weight * otherWeight});
                first = std::min(first, other);
            }
        }
        matrix_.addRow(first);
    }
    diagonal_.resize(rows_.size());
    pull_.resize(rows_.size());
    ease_.resize(clusters_.size());
}

void Pins::listPairs() {
    pairs_.clear();
    for (const Cluster& cluster : clusters_)
        for (int n = cluster.first + 1; n < cluster.last; ++n)
            pairs_.push_back({nodes_[n].number, nodes_[nodes_[n].parent].number, nodes_[n].pin});
    for (const Row& row : rows_) pairs_.push_back({pins_[row.pin].a, pins_[row.pin].b, row.pin});
}

// Points of solids stay, as the solids would lose their shape; points tied to them come.
void Pins::settle(IslandPlan& plan) {
    std::vector<double> inverseMasses = inverseMassesOf(plan);
    for (const Body* body : plan.bodies)
        if (body->spec->isRigid())
            for (const int point : body->pointOf) inverseMasses[point] = 0.0;
    for (const auto& constraint : plan.constraints) {
        const auto* own = dynamic_cast<const Pins*>(constraint.get());
        if (own == nullptr) continue;
        Pins pins = *own;
        const std::vector<int>& points = pins.ends_.points;
        std::vector<double> inverseMass;
        std::vector<dvec3> x, pull(pins.pins_.size());
        for (const int point : points) {
            inverseMass.push_back(inverseMasses[point]);
            x.push_back(plan.positions[point]);
        }
        pins.projectPositions({inverseMass, x, x, {}, pull});
        for (std::size_t i = 0; i < points.size(); ++i) plan.positions[points[i]] = x[i];
    }
}

std::vector<int> Pins::clusterOf(int point) const {
    std::vector<int> all;
    for (const Cluster& cluster : clusters_) {
        std::vector<int> own;
        for (int n = cluster.first; n < cluster.last; ++n)
            if (const int number = nodes_[n].number; !ends_.isPlace(number)) own.push_back(ends_.points[number]);
        if (std::find(own.begin(), own.end(), point) != own.end()) all = own;
    }
    std::sort(all.begin(), all.end());
    return all;
}

std::span<const Constraint::Pair> Pins::pairs(double t) {
    if (t < from_ || t >= until_) layOut(t);
    return pairs_;
}

// Roots of clusters between points come first, then the points that are one with each.
std::optional<std::vector<Constraint::Pair>> Pins::joinedFrom(double t) const {
    if (!ends_.places.empty()) return std::nullopt;
    Pins then = *this;
    then.layOut(t);
    if (then.until_ != HUGE_VAL) return std::nullopt;
    std::vector<Pair> all;
    const auto root = [&](int cluster) { return then.nodes_[then.clusters_[cluster].first].number; };
    std::vector<bool> follows(then.clusters_.size(), false), leads = follows;
    for (const Row& row : then.rows_) {
        // The end that is a point has its whole weight.
        const auto own = std::find_if(row.clusters.begin(), row.clusters.end(),
                                      [](const Spot::Share& share) { return std::abs(share.weight) == 1.0; });
        if (own == row.clusters.end() || follows[own->point]) return std::nullopt;
        follows[own->point] = true;
        std::vector<Spot::Share> shares;
        for (const auto& [cluster, weight] : row.clusters) {
            if (cluster == own->point) continue;
            leads[cluster] = true;
            shares.push_back({root(cluster), -weight / own->weight});
        }
        all.push_back({root(own->point), Spot(shares), row.pin});
    }
    for (std::size_t c = 0; c < leads.size(); ++c)
        if (follows[c] && leads[c]) return std::nullopt;
    for (const Pair& pair : then.pairs(t))
        if (pair.a.isPoint() && pair.b.isPoint()) all.push_back(pair);
    return all;
}

bool Pins::carries(int point) const {
    for (const Cluster& cluster : clusters_) {
        if (!ends_.isPlace(nodes_[cluster.first].number)) continue;
        for (int n = cluster.first; n < cluster.last; ++n)
            if (const int number = nodes_[n].number; !ends_.isPlace(number) && ends_.points[number] == point)
                return true;
    }
    return false;
}

void Pins::check() const {
    for (const Cluster& cluster : clusters_) {
        const int root = nodes_[cluster.first].number;
        for (int n = cluster.first + 1; n < cluster.last; ++n) {
            const Node& node = nodes_[n];
            if (!ends_.isPlace(node.number)) continue;
            const auto placeOf = [&](int number) {
                return ends_.places[static_cast<std::size_t>(number) - ends_.points.size()];
            };
            const std::string first = placeOf(root).collider, second = placeOf(node.number).collider;
            if (first != second)
                throw core::Error(core::ErrorKind::badContent, at(pins_[node.pin].source) + "a point is tied to " +
                                                                   first + " already and cannot go with " + second +
                                                                   " too; take different points");
        }
    }
}

bool Pins::isDue(double t) const {
    return std::any_of(
        pins_.begin(), pins_.end(),
        [&](const Pin& pin) { return pin.closing.length == Closing::notBegun && t >= pin.closing.start; });
}

void Pins::begin(double t, std::span<const dvec3> x) {
    for (Pin& pin : pins_) {
        if (pin.closing.length != Closing::notBegun || !(t >= pin.closing.start)) continue;
        const auto ofPlan = [&](int number) { return ends_.points[number]; };
        const dvec3 d = pin.b.renumbered(ofPlan).of(x) - pin.a.renumbered(ofPlan).of(x);
        pin.closing.length = std::sqrt(glm::dot(d, d));
    }
    layOut(t);
}

void Pins::visitOwn(StateBytes& bytes) {
    for (Pin& pin : pins_) {
        if (!(pin.closing.start > 0)) continue;
        bytes(pin.closing.length);
        bytes.require(pin.closing.length >= 0 || pin.closing.length == Closing::notBegun);
    }
    if (bytes.isReading()) layOut(time_);
}

bool Pins::project(std::span<dvec3> values, const Moment& moment) {
    if (moment.time < from_ || moment.time >= until_) layOut(moment.time);
    bool any = false;
    for (int turn = 0; turn < mostDraws; ++turn) {
        const bool drew = draw(values, moment);
        any = join(values, moment) || drew || any;
        any = joinBetween(values, moment) || any;
        if (!drew) break;
    }
    return any;
}

// Of open pins: along the line between the ends, so that only these two bear it.
bool Pins::draw(std::span<dvec3> values, const Moment& moment) {
    bool any = false;
    const bool isOfPlaces = values.data() == moment.x.data();
    for (const int p : open_) {
        const Pin& pin = pins_[p];
        const dvec3 d = pin.b.of(moment.x) - pin.a.of(moment.x);
        const double length = std::sqrt(glm::dot(d, d)), most = pin.closing.mostAt(moment.time);
        const double weight = pin.a.ease(moment.inverseMass) + pin.b.ease(moment.inverseMass);
        const double slack = (isOfPlaces ? drawnTo : -nearlyDrawn) * pin.closing.length;
        if (!(length > most + slack) || !(weight > 0)) continue;
        const dvec3 along = d / length;
        const double excess =
            isOfPlaces ? length - most
                       : glm::dot(along, pin.b.of(moment.v) - pin.a.of(moment.v)) - pin.closing.speedAt(moment.time);
        if (!(excess > 0)) continue;
        const dvec3 impulse = (excess / weight) * along;
        pin.a.push(values, moment.inverseMass, impulse);
        pin.b.push(values, moment.inverseMass, -impulse);
        moment.pull[p] += impulse;
        any = true;
    }
    return any;
}

// Of closed pins. A node without inverse mass, a place on a collider or a held point, draws all others to it and bears
// the reaction.
bool Pins::join(std::span<dvec3> values, const Moment& moment) {
    bool any = false;
    for (const Cluster& cluster : clusters_) {
        const auto nodes = std::span(nodes_).subspan(cluster.first, cluster.last - cluster.first);
        const auto value = [&](const Node& node) -> dvec3& { return values[node.number]; };
        const auto weight = [&](const Node& node) { return moment.inverseMass[node.number]; };
        const auto fixed = std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return !(weight(n) > 0); });
        // Where the cluster goes: to the fixed node, or to the centre of mass.
        dvec3 target = value(fixed != nodes.end() ? *fixed : nodes.front());
        if (fixed == nodes.end()) {
            dvec3 moved(0.0);
            double mass = 0;
            for (const Node& node : nodes) {
                moved += (value(node) - target) / weight(node);
                mass += 1.0 / weight(node);
            }
            target += moved / mass;
        }
        // Moves the nodes; sum: the displacement of each.
        const std::span<dvec3> sum = std::span(sum_).subspan(cluster.first);
        dvec3 all(0.0);
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const dvec3 way = target - value(nodes[n]);
            any = any || std::sqrt(glm::dot(way, way)) > roundingOfPins * std::sqrt(glm::dot(target, target));
            sum[n] = weight(nodes[n]) > 0 ? way / weight(nodes[n]) : dvec3(0.0);
            all += sum[n];
            if (weight(nodes[n]) > 0) value(nodes[n]) = target;
        }
        if (fixed != nodes.end()) sum[fixed - nodes.begin()] = -all;
        bear(cluster, moment);
    }
    return any;
}

// From the leaves to the root: each pin bears the sum of all nodes beyond it.
void Pins::bear(const Cluster& cluster, const Moment& moment) {
    for (int n = cluster.last; --n > cluster.first;) {
        const Node& node = nodes_[n];
        const dvec3& sum = sum_[n];
        moment.pull[node.pin] += sum;
        sum_[node.parent] += sum;
    }
}

// Of closed pins between points, once each cluster has one value.
bool Pins::joinBetween(std::span<dvec3> values, const Moment& moment) {
    const auto valueOf = [&](int cluster) -> const dvec3& {
        const Node& root = nodes_[clusters_[cluster].first];
        return values[root.number];
    };
    bool isMet = true;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        double size = 0;
        pull_[i] = dvec3(0.0);
        for (const auto& [cluster, weight] : rows_[i].clusters) {
            pull_[i] -= weight * valueOf(cluster);
            size += std::abs(weight) * std::sqrt(glm::dot(valueOf(cluster), valueOf(cluster)));
        }
        isMet = isMet && std::sqrt(glm::dot(pull_[i], pull_[i])) <= roundingOfRows * size;
    }
    if (isMet) return false;
    // A cluster with a node without inverse mass does not move.
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
        double mass = 0;
        for (int n = clusters_[c].first; n < clusters_[c].last; ++n) mass += 1.0 / moment.inverseMass[nodes_[n].number];
        ease_[c] = 1.0 / mass;
    }
    matrix_.clear();
    diagonal_.assign(rows_.size(), 0.0);
    for (const auto& [i, j, cluster, weight] : couplings_)
        (i == j ? diagonal_[i] : matrix_.at(i, j)) += weight * ease_[cluster];
    matrix_.factor(diagonal_);
    matrix_.solve(std::span(pull_));
    // Each node needs its mass times the way of its cluster, of which rows give a part.
    way_.assign(clusters_.size(), dvec3(0.0));
    std::fill(sum_.begin(), sum_.end(), dvec3(0.0));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (const auto& [cluster, weight] : rows_[i].clusters) way_[cluster] += (weight * ease_[cluster]) * pull_[i];
        for (const auto& [number, weight] : rows_[i].points) sum_[nodeOf_[number]] -= weight * pull_[i];
        moment.pull[rows_[i].pin] += pull_[i];
    }
    for (std::size_t c = 0; c < clusters_.size(); ++c) {
        int fixed = -1;
        dvec3 all(0.0);
        for (int n = clusters_[c].first; n < clusters_[c].last; ++n) {
            const auto number = static_cast<std::size_t>(nodes_[n].number);
            dvec3& sum = sum_[n];
            if (moment.inverseMass[number] > 0) {
                values[number] += way_[c];
                sum += way_[c] / moment.inverseMass[number];
                all += sum;
            } else {
                fixed = n;
            }
        }
        if (fixed >= 0) sum_[fixed] = -all;
        bear(clusters_[c], moment);
    }
    return true;
}

}  // namespace taut::world
