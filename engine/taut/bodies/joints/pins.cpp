#include "taut/bodies/private/joints/pins.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"

namespace taut::world {
namespace {

constexpr double roundingOfPins = 1e-15;  // of a coordinate or velocity
constexpr double drawnTo = 1e-9;          // of the length at first: how exactly an open pin draws
constexpr double nearlyDrawn = 1e-6;      // likewise: so near to its most, velocities are drawn
constexpr int mostDraws = 20;             // open pins that share points take turns

}  // namespace

int Pins::numberOf(int point) {
    const auto found = std::find(points_.begin(), points_.end(), point);
    if (found != points_.end()) return static_cast<int>(found - points_.begin());
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
}

void Pins::tie(int a, int b, const Source& source) {
    const int first = numberOf(a), second = numberOf(b);
    pins_.push_back({first, second, source});
    layOut(0.0);
}

void Pins::sew(int a, int b, const Closing& closing, const Source& source) {
    const int first = numberOf(a), second = numberOf(b);
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

void Pins::tie(int a, const Place& b, const Source& source) {
    places_.push_back(b);
    pins_.push_back({numberOf(a), -static_cast<int>(places_.size()), source});
    layOut(0.0);
}

// Walks along the pins that hold and are closed: from each place, then from each remaining point.
void Pins::layOut(double t) {
    time_ = t;
    from_ = 0;
    until_ = HUGE_VAL;
    open_.clear();
    for (int p = 0; p < size(); ++p) {
        const Closing& closing = pins_[static_cast<std::size_t>(p)].closing;
        const double end = closing.end();
        if (t < end)
            until_ = std::min(until_, end);
        else
            from_ = std::max(from_, end);
        if (t < end && holds(p) && closing.length != Closing::notBegun) open_.push_back(p);
    }
    const std::size_t count = points_.size() + places_.size();
    std::vector<std::vector<int>> at(count);  // pins
    for (int p = 0; p < size(); ++p)
        if (holds(p) && t >= pins_[static_cast<std::size_t>(p)].closing.end())
            for (const int number : {pins_[static_cast<std::size_t>(p)].a, pins_[static_cast<std::size_t>(p)].b})
                at[static_cast<std::size_t>(end(number))].push_back(p);
    nodes_.clear();
    clusters_.clear();
    std::vector<bool> isMet(count, false);
    const auto take = [&](int number, int parent, int pin) {
        if (isMet[static_cast<std::size_t>(number)]) return;
        isMet[static_cast<std::size_t>(number)] = true;
        nodes_.push_back({number, parent, pin});
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t root = (i + points_.size()) % count;  // places first
        if (isMet[root] || at[root].empty()) continue;
        Cluster cluster{static_cast<int>(nodes_.size()), 0};
        take(static_cast<int>(root), -1, -1);
        for (std::size_t next = static_cast<std::size_t>(cluster.first); next < nodes_.size(); ++next)
            for (const int p : at[static_cast<std::size_t>(nodes_[next].number)])
                for (const int number : {pins_[static_cast<std::size_t>(p)].a, pins_[static_cast<std::size_t>(p)].b})
                    take(end(number), static_cast<int>(next), p);
        cluster.last = static_cast<int>(nodes_.size());
        clusters_.push_back(cluster);
    }
    sum_.resize(nodes_.size());
}

std::vector<int> Pins::clusterOf(int point) const {
    std::vector<int> all;
    for (const Cluster& cluster : clusters_) {
        std::vector<int> own;
        for (int n = cluster.first; n < cluster.last; ++n)
            if (const int number = nodes_[static_cast<std::size_t>(n)].number; !isPlace(number))
                own.push_back(points_[static_cast<std::size_t>(number)]);
        if (std::find(own.begin(), own.end(), point) != own.end()) all = own;
    }
    std::sort(all.begin(), all.end());
    return all;
}

std::vector<Constraint::Pair> Pins::pairs(double t) {
    if (t < from_ || t >= until_) layOut(t);
    std::vector<Pair> all;
    for (const Cluster& cluster : clusters_)
        for (int n = cluster.first + 1; n < cluster.last; ++n) {
            const Node& node = nodes_[static_cast<std::size_t>(n)];
            all.push_back({node.number, nodes_[static_cast<std::size_t>(node.parent)].number, node.pin});
        }
    return all;
}

std::optional<std::vector<Constraint::Pair>> Pins::joinedFrom(double t) const {
    if (!places_.empty()) return std::nullopt;
    Pins then = *this;
    then.layOut(t);
    if (then.until_ != HUGE_VAL) return std::nullopt;
    return then.pairs(t);
}

bool Pins::carries(int point) const {
    for (const Cluster& cluster : clusters_) {
        if (!isPlace(nodes_[static_cast<std::size_t>(cluster.first)].number)) continue;
        for (int n = cluster.first; n < cluster.last; ++n)
            if (const int number = nodes_[static_cast<std::size_t>(n)].number;
                !isPlace(number) && points_[static_cast<std::size_t>(number)] == point)
                return true;
    }
    return false;
}

void Pins::check() const {
    for (const Cluster& cluster : clusters_) {
        const int root = nodes_[static_cast<std::size_t>(cluster.first)].number;
        for (int n = cluster.first + 1; n < cluster.last; ++n) {
            const Node& node = nodes_[static_cast<std::size_t>(n)];
            if (!isPlace(node.number)) continue;
            const auto placeOf = [&](int number) { return places_[static_cast<std::size_t>(number) - points_.size()]; };
            const std::string first = placeOf(root).collider, second = placeOf(node.number).collider;
            if (first != second)
                throw core::Error(core::ErrorKind::badContent,
                                  at(pins_[static_cast<std::size_t>(node.pin)].source) + "a point is tied to " + first +
                                      " already and cannot go with " + second + " too; take different points");
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
        const auto at = [&](int number) {
            return x[static_cast<std::size_t>(points_[static_cast<std::size_t>(number)])];
        };
        const dvec3 d = at(pin.b) - at(pin.a);
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
        if (!drew) break;
    }
    return any;
}

// Of open pins: along the line between the ends, so that only these two bear it.
bool Pins::draw(std::span<dvec3> values, const Moment& moment) {
    bool any = false;
    const bool isOfPlaces = values.data() == moment.x.data();
    for (const int p : open_) {
        const Pin& pin = pins_[static_cast<std::size_t>(p)];
        const auto a = static_cast<std::size_t>(end(pin.a)), b = static_cast<std::size_t>(end(pin.b));
        const dvec3 d = moment.x[b] - moment.x[a];
        const double length = std::sqrt(glm::dot(d, d)), most = pin.closing.mostAt(moment.time);
        const double weight = moment.inverseMass[a] + moment.inverseMass[b];
        const double slack = (isOfPlaces ? drawnTo : -nearlyDrawn) * pin.closing.length;
        if (!(length > most + slack) || !(weight > 0)) continue;
        const dvec3 along = d / length;
        const double excess =
            isOfPlaces ? length - most : glm::dot(along, moment.v[b] - moment.v[a]) - pin.closing.speedAt(moment.time);
        if (!(excess > 0)) continue;
        const dvec3 impulse = (excess / weight) * along;
        values[a] += moment.inverseMass[a] * impulse;
        values[b] -= moment.inverseMass[b] * impulse;
        moment.pull[static_cast<std::size_t>(p)] += impulse;
        any = true;
    }
    return any;
}

// Of closed pins. A node without inverse mass, a place on a collider or a held point, draws all others to it and bears
// the reaction.
bool Pins::join(std::span<dvec3> values, const Moment& moment) {
    bool any = false;
    for (const Cluster& cluster : clusters_) {
        const auto nodes = std::span(nodes_).subspan(static_cast<std::size_t>(cluster.first),
                                                     static_cast<std::size_t>(cluster.last - cluster.first));
        const auto value = [&](const Node& node) -> dvec3& { return values[static_cast<std::size_t>(node.number)]; };
        const auto weight = [&](const Node& node) { return moment.inverseMass[static_cast<std::size_t>(node.number)]; };
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
        // Moves the nodes; sum: what each is moved by.
        const std::span<dvec3> sum = std::span(sum_).subspan(static_cast<std::size_t>(cluster.first));
        dvec3 all(0.0);
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            const dvec3 way = target - value(nodes[n]);
            any = any || std::sqrt(glm::dot(way, way)) > roundingOfPins * std::sqrt(glm::dot(target, target));
            sum[n] = weight(nodes[n]) > 0 ? way / weight(nodes[n]) : dvec3(0.0);
            all += sum[n];
            if (weight(nodes[n]) > 0) value(nodes[n]) = target;
        }
        if (fixed != nodes.end()) sum[static_cast<std::size_t>(fixed - nodes.begin())] = -all;
        // From the leaves to the root: each pin bears the sum of all nodes beyond it.
        for (std::size_t n = nodes.size(); n-- > 1;) {
            moment.pull[static_cast<std::size_t>(nodes[n].pin)] += sum[n];
            sum[static_cast<std::size_t>(nodes[n].parent - cluster.first)] += sum[n];
        }
    }
    return any;
}

}  // namespace taut::world
