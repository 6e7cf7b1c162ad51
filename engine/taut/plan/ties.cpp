#include "taut/plan/private/ties.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/body/private/solid_places.h"
#include "taut/core/error.h"
#include "taut/plan/mounting.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

[[noreturn]] void fail(const Source& source, const std::string& message) {
    throw core::Error(core::ErrorKind::badContent, at(source) + message);
}

void expectHolder(const std::string& collider, const Holders& holders, const Source& source) {
    if (!holders.poseOf(collider))
        fail(source, "there is no " + collider + " to tie points to; add a table [" + collider + "]");
}

dvec3 placeOn(const collision::Pose& pose, const dvec3& offset) {
    return pose.position + mechanics::PosePath::rotated(pose.rotation, offset);
}

bool isInWorld(const JointSpec& joint) {
    return joint.placeIn == JointSpec::PlaceIn::world;
}

// [m] In the scene; pose: of the joint's collider.
dvec3 placeOf(const JointSpec& joint, const collision::Pose& pose) {
    return isInWorld(joint) ? *joint.place : placeOn(pose, *joint.place);
}

// Points of the body's model, each once.
std::vector<int> namedPoints(const JointSide& side, const Body& body) {
    std::vector<int> points;
    for (const std::string& target : side.targets)
        if (names(target, body))
            for (const int i : selectPoints(body.model, parseTarget(target).selector))
                if (side.targets.size() == 1 || std::find(points.begin(), points.end(), i) == points.end())
                    points.push_back(i);
    return points;
}

// Whether a body ends at the place of a joint, and not at points of its own.
bool endsAtPlace(const JointSpec& joint, const Body& body) {
    return joint.place && body.spec->isRigid() && isWhole(pointsOf(joint));
}

// The ties of the scene to colliders, for one plan.
class Tying {
  public:
    Tying(IslandPlan& plan, const Holders& holders) : plan_(plan), holders_(holders), holder_(plan.points.size()) {}

    void hold(Body& body) {
        std::vector<int> points;
        for (int i : body.carried) points.push_back(body.pointOf[i]);
        const int first = points.front();
        lead(body.spec->holdOn, std::move(points), body.spec->source);
        body.carriedFrom = carrierOf(plan_, first)->path.from;
    }

    void tie(const JointSpec& joint, int number) {
        std::vector<Spot> ends;
        std::vector<int> points;
        const auto at = [&](const Body& body, const dvec3& place) {
            ends.push_back(spotAt(body, place).renumbered([&](int i) { return body.pointOf[i]; }));
        };
        for (const Body* body : plan_.bodies) {
            if (!names(pointsOf(joint), *body)) continue;
            if (endsAtPlace(joint, *body)) {
                at(*body, frameOf(joint, *body).position);
                continue;
            }
            for (const std::string& target : pointsOf(joint).targets)
                if (const auto named = placeNamed(*body, parseTarget(target).selector)) at(*body, *named);
            for (const int i : namedPoints(pointsOf(joint), *body)) points.push_back(body->pointOf[i]);
        }
        if (points.empty() && ends.empty()) return;
        const std::string& collider = colliderOf(joint);
        sort(points);
        expectHolder(collider, holders_, joint.source);
        if (joint.isWeld() && joint.place) moveToPlace(joint, points);
        if (joint.isWeld() && !joint.hasOwnTies() && ends.empty())
            return lead(collider, std::move(points), joint.source);
        ends.insert(ends.end(), points.begin(), points.end());
        if (joint.isMounted() && points.size() > 1)
            fail(joint.source, std::string(joint.title()) + " ties bodies and a collider at a place, and \"" +
                                   pointsOf(joint).text() + "\" are " + std::to_string(points.size()) +
                                   " points; name whole bodies, or one point");
        const std::size_t grips = plan_.grips.size();
        for (const Spot& end : ends) {
            const std::size_t own = plan_.grips.size();
            const int tie = static_cast<int>(plan_.ties.size());
            const int point = end.nearest();
            Grip grip = std::move(tieTo(holders_, collider, std::span(&point, 1), plan_.positions).front());
            if (joint.place)
                grip.offsets.front() = offsetOf(joint, point, grip.holder);
            else if (!end.isPoint())
                grip.offsets.front() = inHolder(grip.holder, end.of(plan_.positions));
            addTie(plan_,
                   {.joint = number,
                    .a = point,
                    .collider = grip.holder,
                    .breakForce = joint.breakForce.value_or(HUGE_VAL),
                    .from = end,
                    .touch = joint.touch},
                   [&] {
                       if (joint.isMounted())
                           mount(joint, end, grip);
                       else
                           joint.carry(plan_, end, std::move(grip));
                   });
            if (joint.isMounted()) plan_.ties.back().offset = grip.offsets.front();
            if (joint.hasOwnTies())
                for (std::size_t g = own; g < plan_.grips.size(); ++g) plan_.grips[g].tie = tie;
        }
        if (!joint.hasOwnTies()) join(grips);
    }

  private:
    // The place of a joint and the axes that its own are in: of a body that is its first side, else of its collider, or
    // of the scene.
    collision::Frame frameOf(const JointSpec& joint, const Body& body) const {
        collision::Frame frame;
        if (isInWorld(joint)) {
            frame = {};
        } else if (isCollider(joint.a) || !endsAtPlace(joint, body)) {
            const collision::Pose pose = *holders_.poseOf(holders_.nearest(colliderOf(joint), body.axes.position));
            frame = {glm::mat3_cast(pose.rotation), pose.position, true};
        } else {
            frame = body.axes;
        }
        frame.position = frame.toWorld(*joint.place);
        return frame;
    }
    dvec3 inHolder(const std::string& holder, const dvec3& place) const {
        const collision::Pose pose = *holders_.poseOf(holder);
        return mechanics::PosePath::rotated(glm::conjugate(pose.rotation), place - pose.position);
    }
    // [m] On the holder, of the place to which a point is tied.
    dvec3 offsetOf(const JointSpec& joint, int point, const std::string& holder) const {
        const Body& body = *authored(plan_, point).first;
        const bool isOnHolder = !endsAtPlace(joint, body) && !isInWorld(joint);
        return isOnHolder ? *joint.place : inHolder(holder, frameOf(joint, body).position);
    }
    void mount(const JointSpec& joint, const Spot& end, const Grip& grip) {
        const Body& body = *authored(plan_, end.nearest()).first;
        Mounting mounting;
        mounting.a = [&](const dvec3& place) {
            if (!body.spec->isRigid()) return end;
            return spotAt(body, place).renumbered([&](int i) { return body.pointOf[i]; });
        };
        mounting.b = [&](const dvec3& place) { return Constraint::Place{grip.holder, inHolder(grip.holder, place)}; };
        mounting.at = frameOf(joint, body);
        // Turns are those of b: as seen from the body, a collider that is a turns the other way.
        if (isCollider(joint.a)) mounting.at.rotation *= -1.0;
        mounting.centre = body.axes.position;
        mounting.size = 0.5 * sizeOf(body);
        joint.mount(plan_, mounting);
        carryBy(plan_, grip.holder, grip.path);
    }

    static void sort(std::vector<int>& points) {
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
    }

    // Points of a weld start at its place.
    void moveToPlace(const JointSpec& joint, std::span<const int> points) {
        for (const int point : points) {
            dvec3& x = plan_.positions[point];
            const collision::Pose pose = *holders_.poseOf(holders_.nearest(colliderOf(joint), x));
            const dvec3 place = placeOf(joint, pose);
            if (const double away = glm::distance(x, place); away > joint.reach())
                fail(joint.source, "place is " + std::to_string(away) + " m from " + nameOf(point) +
                                       ", further than a weld reaches, " + std::to_string(joint.reach()) +
                                       " m; move one of them, or use kind = \"spring\"");
            x = place;
        }
    }

    // Merges all grips from `first` on, of ascending points, into one if one thing carries them.
    void join(std::size_t first) {
        if (plan_.grips.size() <= first + 1) return;
        Grip& all = plan_.grips[first];
        if (std::any_of(plan_.grips.begin() + static_cast<std::ptrdiff_t>(first), plan_.grips.end(),
                        [&](const Grip& own) { return own.holder != all.holder; }))
            return;
        for (std::size_t g = first + 1; g < plan_.grips.size(); ++g) {
            const Grip& own = plan_.grips[g];
            all.points.insert(all.points.end(), own.points.begin(), own.points.end());
            all.offsets.insert(all.offsets.end(), own.offsets.begin(), own.offsets.end());
            all.stiffness.insert(all.stiffness.end(), own.stiffness.begin(), own.stiffness.end());
            all.damping.insert(all.damping.end(), own.damping.begin(), own.damping.end());
            all.lengths.insert(all.lengths.end(), own.lengths.begin(), own.lengths.end());
        }
        plan_.grips.resize(first + 1);
    }

    // Leaves out points that the collider holds already.
    void lead(const std::string& collider, std::vector<int> points, const Source& source) {
        expectHolder(collider, holders_, source);
        sort(points);
        for (int i : points) {
            const std::string& other = holder_[i];
            if (!other.empty() && other != collider)
                fail(source, nameOf(i) + " is tied to " + other + " already and cannot go with " + collider +
                                 " too; take different points");
            if (plan_.points[i].held)
                fail(source, nameOf(i) + " is held in place and cannot go with " + collider +
                                 " too; take it out of `hold`, or give the body hold_on = \"" + collider + "\"");
        }
        std::erase_if(points, [&](int i) { return !holder_[i].empty(); });
        if (points.empty()) return;
        for (int i : points) holder_[i] = collider;
        for (Grip& grip : tieTo(holders_, collider, points, plan_.positions)) plan_.grips.push_back(std::move(grip));
    }

    std::string nameOf(int point) const {
        const auto [body, number] = authored(plan_, point);
        return "point #" + std::to_string(number) + " of " + body->fullName();
    }

    IslandPlan& plan_;
    const Holders& holders_;
    std::vector<std::string> holder_;  // (points) the collider that moves it; empty: none
};

double lengthOf(const dvec3& v) {
    return std::sqrt(glm::dot(v, v));
}

}  // namespace

bool isCollider(const std::string& target) {
    return parseTarget(target).kind == "collider";
}

bool isCollider(const JointSide& side) {
    return std::any_of(
        side.targets.begin(), side.targets.end(), [](const auto& target) { return isCollider(target); });
}

bool isTie(const JointSpec& joint) {
    return isCollider(joint.a) || isCollider(joint.b);
}
const std::string& colliderOf(const JointSpec& joint) {
    return (isCollider(joint.a) ? joint.a : joint.b).targets.front();
}
const JointSide& pointsOf(const JointSpec& joint) {
    return isCollider(joint.a) ? joint.b : joint.a;
}

void expectAtPlace(const JointSpec& joint, const JointSide& side, double away) {
    if (away > weldReach)
        fail(joint.source, std::string(joint.title()) + " holds its sides at one place, and \"" + side.text() +
                               "\" is " + std::to_string(away) +
                               " m from it: move them together, or name the whole body");
}

bool isWhole(const JointSide& side) {
    return std::all_of(
        side.targets.begin(), side.targets.end(),
        [](const auto& target) {
            const std::string selector = parseTarget(target).selector;
            return selector.empty() || selector == "all";
        });
}
bool names(const JointSide& side, const Body& body) {
    return std::any_of(
        side.targets.begin(), side.targets.end(), [&](const auto& target) { return names(target, body); });
}
int countTied(const JointSpec& joint, const JointSide& side, const Body& body) {
    if (endsAtPlace(joint, body)) return names(side, body) ? 1 : 0;
    int places = 0;
    for (const std::string& target : side.targets)
        if (names(target, body) && placeNamed(body, parseTarget(target).selector)) ++places;
    return places + static_cast<int>(namedPoints(side, body).size());
}

void addTies(IslandPlan& plan, const SceneSpec& spec, const Holders& holders) {
    Tying tying(plan, holders);
    for (Body* body : plan.bodies)
        if (!body->carried.empty()) tying.hold(*body);
    int number = 0;
    for (const JointSpec& joint : spec.joints) {
        if (isTie(joint)) tying.tie(joint, number);
        ++number;
    }
}

void checkTies(const SceneSpec& spec, std::span<Body* const> bodies, const Holders& holders) {
    for (const JointSpec& joint : spec.joints) {
        if (!isTie(joint)) continue;
        if (isCollider(joint.a) && isCollider(joint.b))
            fail(joint.source, "both sides of the joint \"" + joint.a.text() + "\" – \"" + joint.b.text() +
                                   "\" are colliders; one has to be points of a body");
        if ((isCollider(joint.a) ? joint.a : joint.b).targets.size() > 1)
            fail(joint.source, "a collider is a side of a joint by itself; write a [[joint]] for each");
        expectHolder(colliderOf(joint), holders, joint.source);
        for (const std::string& target : pointsOf(joint).targets) {
            const JointSide one(target);
            for (const Body* body : bodies)
                if (joint.isMounted() && joint.place && names(one, *body) && body->spec->isRigid() && !isWhole(one)) {
                    const collision::Pose pose =
                        *holders.poseOf(holders.nearest(colliderOf(joint), body->axes.position));
                    const std::optional<dvec3> named = placeNamed(*body, parseTarget(target).selector);
                    for (const int i : namedPoints(one, *body))
                        expectAtPlace(
                            joint, one,
                            glm::distance(body->model.positions[static_cast<std::size_t>(i)], placeOf(joint, pose)));
                    if (named) expectAtPlace(joint, one, glm::distance(*named, placeOf(joint, pose)));
                }
            if (std::all_of(bodies.begin(), bodies.end(),
                            [&](const Body* body) { return countTied(joint, one, *body) == 0; }))
                fail(joint.source, "\"" + target + "\" names no point");
        }
    }
}

void expectClosable(const IslandPlan& plan, const SceneSpec& spec, const Holders& holders) {
    const auto isHeld = [&](int point) {
        const Body* body = authored(plan, point).first;
        const bool isSolid = body != nullptr && body->spec->isRigid();
        return plan.points[static_cast<std::size_t>(point)].held ||
               (isSolid &&
                (!body->carried.empty() || std::count(body->model.held.begin(), body->model.held.end(), true) > 0));
    };
    for (const JointTie& tie : plan.ties)
        for (const JointTie::Part& part : tie.parts) {
            const auto constraint = plan.constraints[static_cast<std::size_t>(part.constraint)]->copy();
            const std::span<const int> points = constraint->points();
            std::vector<dvec3> x;
            for (const int point : points) x.push_back(plan.positions[static_cast<std::size_t>(point)]);
            for (const Constraint::Place& place : constraint->places()) {
                const collision::Pose pose = *holders.poseOf(place.collider);
                x.push_back(placeOn(pose, place.offset));
            }
            for (const Constraint::Pair& pair : constraint->pairs(0.0)) {
                const auto stays = [&](const Spot& end) {
                    const auto number = static_cast<std::size_t>(end.nearest());
                    return number >= points.size() || isHeld(points[number]);
                };
                const double gap = lengthOf(pair.a.of(x) - pair.b.of(x));
                if (pair.tie != part.tie || pair.length > 0 || !(gap > weldReach) || !stays(pair.a) || !stays(pair.b))
                    continue;
                const JointSpec& joint = spec.joints[static_cast<std::size_t>(tie.joint)];
                fail(joint.source, "the joint \"" + joint.a.text() + "\" – \"" + joint.b.text() + "\" is open by " +
                                       std::to_string(gap) +
                                       " m, and its sides are held: move them together, or leave `hold` out of one");
            }
        }
}

std::vector<Grip> tieTo(const Holders& holders, const std::string& collider, std::span<const int> points,
                        std::span<const dvec3> x) {
    std::vector<Grip> grips;
    for (int i : points) {
        const dvec3& place = x[i];
        const std::string holder = holders.nearest(collider, place);
        const collision::Pose pose = holders.poseOf(holder).value();
        auto grip = std::find_if(grips.begin(), grips.end(), [&](const Grip& own) { return own.holder == holder; });
        if (grip == grips.end()) {
            grip = grips.emplace(grips.end());
            grip->holder = holder;
            grip->ofCollider = true;
            grip->rigid = true;
            grip->path = pathOf(pose, pose, 0.0, 1.0);
        }
        grip->points.push_back(i);
        grip->offsets.push_back(mechanics::PosePath::rotated(glm::conjugate(pose.rotation), place - pose.position));
    }
    return grips;
}

const Grip* carrierOf(const IslandPlan& plan, int point) {
    for (const Grip& grip : plan.grips)
        if (grip.ofCollider && grip.rigid && std::binary_search(grip.points.begin(), grip.points.end(), point))
            return &grip;
    return nullptr;
}

bool untie(IslandPlan& plan, std::span<const int> points) {
    bool any = false;
    for (Grip& grip : plan.grips) {
        if (!grip.ofCollider) continue;
        Grip left = grip;
        left.points.clear();
        left.offsets.clear();
        left.stiffness.clear();
        left.damping.clear();
        left.lengths.clear();
        for (std::size_t i = 0; i < grip.points.size(); ++i) {
            if (std::find(points.begin(), points.end(), grip.points[i]) != points.end()) continue;
            left.points.push_back(grip.points[i]);
            left.offsets.push_back(grip.offsets[i]);
            if (grip.rigid) continue;
            left.stiffness.push_back(grip.stiffness[i]);
            left.damping.push_back(grip.damping[i]);
            if (!grip.lengths.empty()) left.lengths.push_back(grip.lengths[i]);
        }
        any = any || left.points.size() < grip.points.size();
        grip = std::move(left);
    }
    std::erase_if(plan.grips, [](const Grip& grip) { return grip.points.empty(); });
    return any;
}

mechanics::PosePath pathOf(const collision::Pose& from, const collision::Pose& to, double t0, double ticksPerSecond) {
    const auto place =
        from.position == to.position
            ? mechanics::LinearPath{from.position, from.position}
            : mechanics::LinearPath::line(from.position, (to.position - from.position) * ticksPerSecond, t0);
    return {place, from.rotation, to.rotation, t0, t0 + 1.0 / ticksPerSecond};
}

bool isOther(const dvec3& a, const dvec3& b) {
    return lengthOf(b - a) > 1e-9 * std::max(lengthOf(a), lengthOf(b));
}

bool goesOn(const mechanics::PosePath& before, const mechanics::PosePath& after, double t) {
    constexpr double rounding = 1e-12;
    const mechanics::PosePath::Frame a = before.at(t), b = after.at(t);
    const glm::dquat turn = b.rotation * glm::conjugate(a.rotation);
    return lengthOf(b.place - a.place) <= rounding * (1.0 + lengthOf(a.place)) && !isOther(a.velocity, b.velocity) &&
           !isOther(a.spin, b.spin) && lengthOf({turn.x, turn.y, turn.z}) <= rounding;
}

}  // namespace taut::world
