#include "taut/island/private/envelope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "taut/core/error.h"
#include "taut/forces/private/scene_forces.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/actions.h"
#include "taut/spec/spec.h"
#include "taut/spec/targets.h"

namespace taut::world {
namespace {

double size(const std::vector<double>& value) {
    double sum = 0;
    for (double v : value) sum += v * v;
    return sum;
}

bool changesIslands(const RampAction& ramp) {
    TAUT_EXPECTS(ramp.field != nullptr);
    return ramp.field->affects == fields::Affects::forces || ramp.field->affects == fields::Affects::springs;
}

// The scene with every field that ramps change at its largest value, or at its smallest. A ramp begins between the
// values before it and stays between its ends, so no other values count.
SceneSpec extreme(const SceneSpec& spec, bool largest) {
    SceneSpec scene = spec;
    foreseen<RampAction>(spec.actions, [&](const RampAction& ramp) {
        if (!changesIslands(ramp)) return;
        const double now = size(ramp.field->read(scene)), later = size(ramp.value);
        if (largest ? later > now : later < now) ramp.field->write(scene, ramp.value);
    });
    return scene;
}

// The points, in island numbers, that an action names.
std::vector<int> pointsOf(const IslandPlan& plan, const std::string& target) {
    std::vector<int> points;
    for (const Body* body : matchBodies(plan.bodies, target))
        for (int i : selectPoints(body->model, parseTarget(target).selector)) points.push_back(body->pointOf[i]);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

auto& point(IslandPlan& plan, int i) {
    return plan.points[i];
}

// Whether [hand] anywhere already allows for this grab: a grip has at least the mass of each of its points. So a
// recorded scene has the same steps as when it was played live.
bool isAllowedAnywhere(const GrabAction& grab, const HandSpec& hand) {
    return hand.anywhere && grab.id.starts_with(liveHand) && grab.strength <= hand.strength &&
           grab.dampingRatio <= hand.dampingRatio;
}

void lighten(Envelope& envelope, const SceneSpec& spec) {
    foreseen<AddMassAction>(
        spec.actions,
        [&](const AddMassAction& action) {
            if (action.mass >= 0) return;
            const std::vector<int> points = pointsOf(envelope.plan, action.target);
            for (int i : points) {
                double& mass = point(envelope.plan, i).mass;
                mass += action.near ? action.mass : action.mass / static_cast<double>(points.size());
                if (!(mass > 0))
                    throw core::Error(core::ErrorKind::badContent,
                                      at(action.source) + "this may leave a point of \"" + action.target +
                                          "\" without any mass; take away less, or from more points");
            }
        });
}

// Adds grabs by springs. The mass of a grip is at least that of its points that are always free. Where the nearest
// point is not known yet, it is at least that of the lightest point.
void addHands(Envelope& envelope, const IslandPlan& start, const SceneSpec& spec) {
    std::vector<bool> mayBeHeld;
    for (const auto& p : start.points) mayBeHeld.push_back(p.held);
    const auto mayHold = [&](const PointsAction& action) {
        for (int i : pointsOf(start, action.target)) mayBeHeld[i] = true;
    };
    foreseen<HoldAction>(spec.actions, mayHold);
    foreseen<GrabAction>(spec.actions, [&](const GrabAction& grab) {
        if (grab.rigid) mayHold(grab);
    });
    std::map<std::string, std::vector<GripRates>> hands;  // (points) by id
    foreseen<GrabAction>(spec.actions, [&](const GrabAction& action) {
        if (action.rigid || isAllowedAnywhere(action, spec.hand)) return;
        const std::vector<int> named = pointsOf(envelope.plan, action.target);
        if (named.empty()) return;
        double mass = 0, lightest = HUGE_VAL;
        for (int i : named) {
            lightest = std::min(lightest, point(envelope.plan, i).mass);
            if (!mayBeHeld[i]) mass += point(envelope.plan, i).mass;
        }
        if (action.near || mass == 0) mass = lightest;
        const GripRates rates = gripRates(action.strength, action.dampingRatio, mass);
        std::vector<GripRates>& hand = hands[action.id];
        hand.resize(envelope.plan.points.size());
        // With a radius any point of the bodies may come near.
        const std::string bodies(withoutSelector(action.target));
        for (int i : action.radius > 0 ? pointsOf(envelope.plan, bodies) : named) {
            GripRates& most = hand[i];
            most.omega2 = std::max(most.omega2, rates.omega2);
            most.damping = std::max(most.damping, rates.damping);
        }
    });
    for (std::size_t i = 0; i < envelope.plan.points.size(); ++i) {
        const double mass = envelope.plan.points[i].mass;
        double stiffness = 0, rate = 0;
        if (spec.hand.anywhere) {
            const GripRates one = gripRates(spec.hand.strength, spec.hand.dampingRatio, mass);
            stiffness += mass * one.omega2;
            rate += one.damping;
        }
        for (const auto& [id, hand] : hands) {
            stiffness += mass * hand[i].omega2;
            rate += hand[i].damping;
        }
        envelope.handStiffness.push_back(stiffness);
        envelope.handRate.push_back(rate);
    }
}

// Takes `held` from one plan and drag from the other.
void addDrag(Envelope& envelope, const IslandPlan& of) {
    for (std::size_t i = 0; i < of.points.size(); ++i) {
        if (envelope.plan.points[i].held) continue;
        envelope.leastDrag = std::min(envelope.leastDrag, of.points[i].dragRate);
        envelope.mostDrag = std::max(envelope.mostDrag, of.points[i].dragRate);
    }
}

// The forces at their strongest, as the scene makes them. Forces that the scene does not know stay as they are.
ForceList strongest(const ForceList& forces, const SceneSpec& strong) {
    const ForceList scene = sceneForces(strong);
    ForceList all = forces;
    for (auto& force : all)
        for (const auto& other : scene)
            if (other->name() == force->name()) force = other;
    for (const auto& other : scene)
        if (std::none_of(all.begin(), all.end(), [&](const auto& f) { return f->name() == other->name(); }))
            all.push_back(other);
    return all;
}

}  // namespace

double largestTau(const IslandPlan& plan) {
    double tau = 0;
    for (const mechanics::Spring& spring : plan.springs) tau = std::max(tau, spring.dampingTime);
    return tau;
}

// One extreme of the scene, with its bodies and plans.
struct EnvelopeSide {
    SceneSpec spec;
    std::vector<std::shared_ptr<Body>> bodies;
    std::vector<IslandPlan> plans;                      // of the bodies present from the start
    std::map<std::string, std::size_t> bodyOf, planOf;  // by name; a plan by the name of its first body

    explicit EnvelopeSide(SceneSpec scene) : spec(std::move(scene)) {
        std::vector<Body*> first;
        for (Body& body : buildBodies(spec)) {
            bodies.push_back(std::make_shared<Body>(std::move(body)));
            if (!isSpawnedLater(*bodies.back(), spec)) first.push_back(bodies.back().get());
        }
        plans = planIslands(first, spec);
        for (IslandPlan& plan : plans) tie(plan);
        for (std::size_t i = 0; i < bodies.size(); ++i) bodyOf.emplace(bodies[i]->fullName(), i);
        for (std::size_t i = 0; i < plans.size(); ++i) planOf.emplace(plans[i].bodies.front()->fullName(), i);
    }

    // The plan of the same bodies, or nothing if the scene does not have them.
    std::optional<IslandPlan> like(const IslandPlan& plan, bool hasJoints) const {
        const std::string name = plan.bodies.front()->fullName();
        if (hasJoints) {
            const auto found = planOf.find(name);
            return found == planOf.end() ? std::nullopt : std::optional<IslandPlan>(plans[found->second]);
        }
        const auto found = bodyOf.find(name);
        if (found == bodyOf.end()) return std::nullopt;
        SceneSpec alone;
        alone.solver = spec.solver;
        IslandPlan own = planIslands(std::vector<Body*>{bodies[found->second].get()}, alone).front();
        tie(own);
        return own;
    }

    // Ties points to colliders, wherever these are: only the springs of the ties matter here.
    void tie(IslandPlan& plan) const {
        addTies(plan, spec,
                {[](const std::string&) { return std::optional<collision::Pose>(collision::Pose{}); },
                 [](const std::string& collider, const dvec3&) { return collider; }});
    }
};

struct Envelopes::Impl {
    const SceneSpec& spec;
    std::optional<EnvelopeSide> high, low;
};

GripRates gripRates(double strength, double dampingRatio, double mass) {
    return {strength / mass, 2.0 * dampingRatio * std::sqrt(strength / mass)};
}

bool isSpawnedLater(const Body& body, const SceneSpec& spec) {
    return anyForeseen<SpawnAction>(
        spec.actions,
        [&](const SpawnAction& spawn) {
            const Target target = parseTarget(spawn.target);
            return target.kind == body.kind() && (matches(target.name, body.name) || matches(target.name, body.base()));
        });
}

Envelopes::Envelopes(const SceneSpec& spec) : impl_(new Impl{spec, {}, {}}) {
    if (!anyForeseen<RampAction>(spec.actions, changesIslands)) return;
    impl_->high.emplace(extreme(spec, true));
    impl_->low.emplace(extreme(spec, false));
}
Envelopes::~Envelopes() = default;

Envelope Envelopes::of(const IslandPlan& plan, const ForceList& forces, bool hasJoints) const {
    const SceneSpec& spec = impl_->spec;
    Envelope envelope;
    envelope.plan = plan;
    envelope.forces = forces;
    envelope.isStatic = spec.actions.empty();
    std::optional<IslandPlan> soft;
    if (impl_->high) {
        if (std::optional<IslandPlan> stiff = impl_->high->like(plan, hasJoints)) {
            const SceneSpec& strong = impl_->high->spec;
            envelope.plan = std::move(*stiff);
            envelope.bodies = impl_->high->bodies;
            envelope.forces = strongest(forces, strong);
            soft = impl_->low->like(plan, hasJoints);
        }
    }
    foreseen<FreeAction>(spec.actions, [&](const FreeAction& action) {
        for (int i : pointsOf(envelope.plan, action.target)) point(envelope.plan, i).held = false;
    });
    lighten(envelope, spec);
    const bool hasHands =
        spec.hand.anywhere || anyForeseen<GrabAction>(spec.actions, [](const GrabAction&) { return true; });
    if (hasHands) addHands(envelope, plan, spec);

    envelope.leastTau = largestTau(soft ? *soft : envelope.plan);
    envelope.leastDrag = HUGE_VAL;
    addDrag(envelope, envelope.plan);
    if (soft) addDrag(envelope, *soft);
    if (envelope.leastDrag == HUGE_VAL) envelope.leastDrag = 0;  // no point is ever free
    return envelope;
}

}  // namespace taut::world
