#include "taut/world/encounters.h"

#include <algorithm>
#include <cmath>

#include "taut/world/forces/anchor.h"
#include "taut/world/impl.h"

namespace taut::world {
namespace {

constexpr double sampleSeconds = 1.0 / 30;
constexpr double longestLook = 10.0;  // [s]
constexpr double mostTrials = 2e8;    // of a point against a point, about a second

struct Box {
    dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
    void add(const dvec3& x) {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    Box shifted(const dvec3& by) const { return {low + by, high + by}; }
    Box joined(const Box& other) const { return {glm::min(low, other.low), glm::max(high, other.high)}; }
    Box grown(double by) const { return {low - by, high + by}; }
    // Sharing a face does not count.
    bool overlaps(const Box& other) const {
        return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
    }
};

// Where one body goes: its points, as they start, by the same shift at each sample.
struct Way {
    const Body* body = nullptr;
    const void* group = nullptr;  // bodies tied together
    Box box;
    Box whole;                  // of all samples
    double reach = 0;           // [m] half its longest spring
    int begin = 0;              // sample at which it comes
    std::vector<dvec3> shifts;  // (samples since then)

    const dvec3& shift(int sample) const {
        return shifts[std::min(static_cast<std::size_t>(sample - begin), shifts.size() - 1)];
    }
    Box boxDuring(int sample) const { return box.shifted(shift(sample)).joined(box.shifted(shift(sample + 1))); }
};

// A set of bodies that are tied together, and what moves them.
struct Group {
    std::vector<const Body*> bodies;
    bool isHeld = false;
    double t = 0;       // [s] at which it comes
    dvec3 velocity{0};  // [m/s] mean
};

class Outlook {
  public:
    explicit Outlook(WorldImpl& world)
        : world_(world),
          colliders_(world.colliders()),
          samples_(static_cast<int>(std::ceil(std::min(longestLook, world.spec.run.seconds) / sampleSeconds))) {
        for (const auto& island : world.islands) {
            Group group;
            for (const Body* body : island->plan().bodies) group.bodies.push_back(body);
            group.isHeld = !island->plan().grips.empty();  // on colliders, as the scene starts
            add(std::move(group));
        }
        for (const auto& body : world.waiting) add({{body.get()}, false, spawnTime(*body), {}});
        std::sort(ways_.begin(), ways_.end(), [](const Way& a, const Way& b) { return a.whole.low.x < b.whole.low.x; });
    }

    std::vector<std::pair<std::string, std::string>> pairs() {
        std::vector<std::pair<std::string, std::string>> found;
        for (std::size_t i = 0; i < ways_.size(); ++i)
            for (std::size_t j = i + 1; j < ways_.size() && ways_[j].whole.low.x < ways_[i].whole.high.x; ++j) {
                const Way &a = ways_[i], &b = ways_[j];
                if (++trials_ > mostTrials) return found;
                const bool bothTouch = a.body->spec->touch != Touch::nothing && b.body->spec->touch != Touch::nothing;
                if (a.group == b.group || bothTouch || !a.whole.overlaps(b.whole) || !meet(a, b)) continue;
                const bool isBefore = sortsBefore(*a.body, *b.body);
                found.emplace_back((isBefore ? a : b).body->fullName(), (isBefore ? b : a).body->fullName());
            }
        std::sort(found.begin(), found.end());
        return found;
    }

  private:
    double spawnTime(const Body& body) const {
        double t = HUGE_VAL;
        foreseen<SpawnAction>(world_.start->actions, [&](const SpawnAction& spawn) {
            if (names(spawn.target, body)) t = std::min(t, spawn.t);
        });
        return t;
    }

    bool isAnchored(const Body& body) const {
        const auto anchors = world_.spec.forces.of<AnchorSpec>();
        return std::any_of(anchors.begin(), anchors.end(),
                           [&](const AnchorSpec& anchor) { return names(anchor.target, body); });
    }

    void add(Group group) {
        double mass = 0;
        for (const Body* body : group.bodies) {
            const mechanics::Model& model = body->model;
            group.isHeld = group.isHeld || isAnchored(*body) || !body->carried.empty() ||
                           std::find(model.held.begin(), model.held.end(), true) != model.held.end();
            for (std::size_t i = 0; i < model.positions.size(); ++i) {
                group.velocity += model.masses[i] * model.velocities[i];
                mass += model.masses[i];
            }
        }
        group.velocity /= mass;
        const int begin = static_cast<int>(group.t / sampleSeconds);
        if (begin > samples_) return;
        const std::vector<dvec3> shifts = shiftsOf(group, samples_ - begin);
        for (const Body* body : group.bodies) ways_.push_back(wayOf(*body, group.bodies.front(), begin, shifts));
    }

    // Until the middle of a body, or of its underside, is in a collider.
    std::vector<dvec3> shiftsOf(const Group& group, int samples) const {
        std::vector<dvec3> shifts{dvec3(0.0)};
        for (int k = 1; k <= samples && !group.isHeld; ++k) {
            const double t = k * sampleSeconds;
            const dvec3 shift = t * group.velocity + 0.5 * t * t * world_.spec.world.gravity;
            for (const Body* body : group.bodies) {
                if (!body->spec->collide) continue;
                const Box box = boxOf(*body).shifted(shift);
                const dvec3 middle = 0.5 * (box.low + box.high), under{middle.x, box.low.y, middle.z};
                if (colliders_.inside(middle).collider >= 0 || colliders_.inside(under).collider >= 0) return shifts;
            }
            shifts.push_back(shift);
        }
        return shifts;
    }

    static Box boxOf(const Body& body) {
        Box box;
        for (const dvec3& x : body.model.positions) box.add(x);
        return box;
    }

    static Way wayOf(const Body& body, const void* group, int begin, const std::vector<dvec3>& shifts) {
        Way way{&body, group, boxOf(body), {}, 0, begin, shifts};
        for (const dvec3& shift : shifts) way.whole = way.whole.joined(way.box.shifted(shift));
        for (const mechanics::Spring& spring : body.model.springs)
            way.reach = std::max(way.reach, 0.5 * lengthOf(spring, body.model.positions));
        return way;
    }

    bool meet(const Way& a, const Way& b) {
        const int first = std::max(a.begin, b.begin);
        const int last = first + static_cast<int>(std::max(a.shifts.size(), b.shifts.size()));
        for (int k = first; k < last && trials_ <= mostTrials; ++k)
            if (a.boxDuring(k).overlaps(b.boxDuring(k)) && pointsMeet(a, b, k)) return true;
        return false;
    }

    // Seen from b, points of a go straight by `way` during a sample.
    bool pointsMeet(const Way& a, const Way& b, int sample) {
        const double near = a.reach + b.reach;
        const dvec3 from = a.shift(sample) - b.shift(sample), to = a.shift(sample + 1) - b.shift(sample + 1);
        const dvec3 way = to - from;
        const double length2 = glm::dot(way, way);
        const Box aBox = a.box.shifted(from).joined(a.box.shifted(to)).grown(near);
        std::vector<dvec3> others;
        for (const dvec3& x : b.body->model.positions)
            if (aBox.overlaps({x, x})) others.push_back(x);
        trials_ += static_cast<double>(others.size()) * a.body->model.pointCount();
        for (const dvec3& start : a.body->model.positions)
            for (const dvec3& x : others) {
                const dvec3 d = x - (start + from);
                const double share = length2 > 0 ? std::clamp(glm::dot(d, way) / length2, 0.0, 1.0) : 0.0;
                const dvec3 apart = d - share * way;
                if (glm::dot(apart, apart) < near * near) return true;
            }
        return false;
    }

    WorldImpl& world_;
    collision::Colliders colliders_;
    int samples_;
    std::vector<Way> ways_;
    double trials_ = 0;
};

}  // namespace

std::vector<std::pair<std::string, std::string>> encounters(World& world) {
    return Outlook(WorldAccess::of(world)).pairs();
}

}  // namespace taut::world
