// The ties of a plan, and its cells, bending and points as damage and holds have left them.
#include "taut/plan/island_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "taut/mechanics/bending.h"
#include "taut/plan/constraint.h"
#include "taut/spec/solver_spec.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(Grip);
TAUT_VALUE_MEMBERS(IslandPlan);
TAUT_VALUE_MEMBERS(JointReport);

void addTie(IslandPlan& plan, JointTie tie, const std::function<void()>& add) {
    const std::size_t springs = plan.springs.size(), grips = plan.grips.size();
    std::vector<int> sizes;  // of the constraints before `add`
    for (const auto& constraint : plan.constraints) sizes.push_back(constraint->size());
    add();
    for (std::size_t s = springs; s < plan.springs.size(); ++s) tie.springs.push_back(static_cast<int>(s));
    sizes.resize(plan.constraints.size(), 0);
    for (std::size_t c = 0; c < sizes.size(); ++c) {
        const Constraint& constraint = *plan.constraints[c];
        for (int own = sizes[c]; own < constraint.size(); ++own) tie.parts.push_back({static_cast<int>(c), own});
        if (constraint.size() > sizes[c] && tie.b < 0 && !constraint.places().empty())
            tie.offset = constraint.places().back().offset;
    }
    tie.isGrip = plan.grips.size() > grips;
    if (tie.isGrip) tie.offset = plan.grips.back().offsets.back();
    if (tie.isGrip || !tie.springs.empty() || !tie.parts.empty()) plan.ties.push_back(std::move(tie));
}

namespace {

// Whether the grip belongs to this tie alone or serves several, this one among them.
bool isOf(const Grip& grip, const IslandPlan& plan, const JointTie& tie) {
    if (grip.tie >= 0) return &plan.ties[grip.tie] == &tie;
    return grip.ofCollider && grip.holder == tie.collider &&
           std::binary_search(grip.points.begin(), grip.points.end(), tie.a);
}

}  // namespace

bool holds(const IslandPlan& plan, const JointTie& tie) {
    return std::any_of(
               tie.springs.begin(), tie.springs.end(), [&](int s) { return !plan.broken[s]; }) ||
           std::any_of(
               tie.parts.begin(), tie.parts.end(),
               [&](const JointTie::Part& part) { return plan.constraints[part.constraint]->holds(part.tie); }) ||
           (tie.isGrip &&
            std::any_of(
                plan.grips.begin(), plan.grips.end(), [&](const Grip& grip) { return isOf(grip, plan, tie); }));
}

bool letGo(IslandPlan& plan, std::size_t number) {
    const JointTie& tie = plan.ties[number];
    if (!holds(plan, tie)) return false;
    for (const int s : tie.springs) {
        plan.broken[s] = true;
        plan.springs[s].stiffness = 0;
    }
    for (const JointTie::Part& part : tie.parts) {
        auto& constraint = plan.constraints[part.constraint];
        std::shared_ptr<Constraint> changed = constraint->copy();
        changed->letGo(part.tie);
        constraint = std::move(changed);
    }
    std::erase_if(plan.grips, [&](const Grip& grip) { return grip.tie == static_cast<int>(number); });
    return true;
}

void carryBy(IslandPlan& plan, const std::string& collider, const mechanics::PosePath& path) {
    const bool isThere = std::any_of(plan.carriers.begin(), plan.carriers.end(),
                                     [&](const Carrier& carrier) { return carrier.collider == collider; });
    if (!isThere) plan.carriers.push_back({collider, path});
}

const mechanics::PosePath& pathOf(const IslandPlan& plan, const std::string& collider) {
    const auto isIt = [&](const Carrier& carrier) { return carrier.collider == collider; };
    return std::find_if(plan.carriers.begin(), plan.carriers.end(), isIt)->path;
}

void takeSpringsFromModels(IslandPlan& plan) {
    for (std::size_t s = 0; s < plan.springs.size(); ++s) {
        const SpringOrigin& origin = plan.origins[s];
        if (origin.body < 0 || plan.broken[s]) continue;
        const mechanics::Model& model = plan.bodies[origin.body]->model;
        plan.springs[s].stiffness = model.springs[origin.spring].stiffness;
        plan.springs[s].dampingTime = model.springs[origin.spring].dampingTime;
    }
    // The drag of welded points is weighted by mass, as in the planner.
    std::vector<double> mass(plan.points.size(), 0.0);
    for (const Body* body : plan.bodies)
        for (std::size_t i = 0; i < body->pointOf.size(); ++i) {
            const auto at = static_cast<std::size_t>(body->pointOf[i]);
            const double more = body->model.masses[i];
            double& drag = plan.points[at].dragRate;
            drag = mass[at] == 0 ? body->model.dragRates[i]
                                 : (mass[at] * drag + more * body->model.dragRates[i]) / (mass[at] + more);
            mass[at] += more;
        }
}

const ode::Methods& methodsOf(const SolverSpec& solver) {
    return solver.methods != nullptr ? *solver.methods : ode::builtInMethods();
}

std::vector<double> inverseMassesOf(const IslandPlan& plan) {
    std::vector<double> inverseMasses;
    for (const mechanics::PointMass& p : plan.points) inverseMasses.push_back(p.held ? 0.0 : 1.0 / p.mass);
    return inverseMasses;
}

std::vector<mechanics::VolumeCell> cellsOf(const Body& body) {
    std::vector<mechanics::VolumeCell> cells;
    for (std::size_t c = 0; c < body.model.cells.size(); ++c) {
        if (body.damage.isCellGone(c)) continue;
        cells.push_back(body.model.cells[c]);
        for (int& i : cells.back().points) i = body.pointOf[i];
    }
    return cells;
}

std::vector<mechanics::VolumeCell> cellsOf(const IslandPlan& plan) {
    std::vector<mechanics::VolumeCell> all;
    for (const Body* body : plan.bodies) {
        const std::vector<mechanics::VolumeCell> cells = cellsOf(*body);
        all.insert(all.end(), cells.begin(), cells.end());
    }
    return all;
}

namespace {

// (points of the body) which are held, and of which of them the direction is held too.
struct HeldPoints {
    std::vector<bool> isHeld, isClamped;
};

HeldPoints heldPointsOf(const IslandPlan& plan, const Body& body) {
    const std::vector<bool> isHeld = heldPointsOf(plan);
    HeldPoints of;
    for (std::size_t i = 0; i < body.pointOf.size(); ++i) {
        of.isHeld.push_back(isHeld[body.pointOf[i]]);
        of.isClamped.push_back(of.isHeld[i] && !body.clamped.empty() && body.clamped[i]);
    }
    return of;
}

mechanics::Bending presentOf(const IslandPlan& plan, const Body& body, const mechanics::Bending& bending) {
    if (bending.isEmpty()) return {};
    const auto [isHeld, isClamped] = heldPointsOf(plan, body);
    return without(clamped(bending, isHeld, isClamped, body.model.positions),
                   [&](int a, int b) { return body.damage.isSevered(a, b); });
}

}  // namespace

mechanics::Bending gridBendingOf(const IslandPlan& plan, const Body& body) {
    return presentOf(plan, body, body.model.bending);
}

mechanics::BendingFriction gridFrictionOf(const IslandPlan& plan, const Body& body) {
    mechanics::BendingFriction friction = body.model.friction;
    friction.stuck = presentOf(plan, body, friction.stuck);
    return friction;
}

std::vector<mechanics::BendingElement> bendingElementsOf(const IslandPlan& plan, const Body& body) {
    if (body.model.freeform.isEmpty()) return {};
    const auto [isHeld, isClamped] = heldPointsOf(plan, body);
    return mechanics::bendingElements(body.model, isHeld, isClamped,
                                      [&](int a, int b) { return body.damage.isSevered(a, b); });
}

std::pair<const Body*, int> authored(const IslandPlan& plan, int point) {
    for (const Body* body : plan.bodies)
        for (std::size_t i = 0; i < body->pointOf.size(); ++i)
            if (body->pointOf[i] == point) return {body, static_cast<int>(i)};
    return {nullptr, point};
}

bool isPinned(const IslandPlan& plan, int point) {
    return std::any_of(
        plan.constraints.begin(), plan.constraints.end(),
        [&](const auto& constraint) { return constraint->carries(point); });
}

std::vector<bool> heldPointsOf(const IslandPlan& plan) {
    std::vector<bool> isHeld;
    for (const mechanics::PointMass& p : plan.points) isHeld.push_back(p.held);
    for (const auto& constraint : plan.constraints)
        for (const int i : constraint->points())
            if (constraint->carries(i)) isHeld[i] = true;
    for (const Grip& grip : plan.grips)
        if (grip.ofCollider && grip.rigid)
            for (int i : grip.points) isHeld[i] = true;
    return isHeld;
}

bool isFree(const IslandPlan& plan, int point) {
    return !plan.points[point].held && !isPinned(plan, point) &&
           std::none_of(
               plan.grips.begin(), plan.grips.end(),
               [&](const Grip& grip) {
                   return grip.rigid && std::binary_search(grip.points.begin(), grip.points.end(), point);
               });
}

double lengthOf(const mechanics::Spring& spring, std::span<const dvec3> x) {
    const dvec3 d = x[spring.b] - x[spring.a];
    return std::sqrt(glm::dot(d, d));
}

std::string describeSpring(const IslandPlan& plan, int spring) {
    static constexpr const char* kinds[] = {"structural", "shear", "bend", "joint"};
    const mechanics::Spring& s = plan.springs[spring];
    std::string text = std::string(kinds[static_cast<int>(s.kind)]) + " spring ";
    const auto [bodyA, a] = authored(plan, s.a);
    const auto [bodyB, b] = authored(plan, s.b);
    text += std::to_string(a) + "–" + std::to_string(b);
    if (bodyA != nullptr) text += " of " + bodyA->fullName();
    if (bodyB != bodyA && bodyB != nullptr) text += " and " + bodyB->fullName();
    return text;
}

}  // namespace taut::world
