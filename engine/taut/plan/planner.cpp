// From bodies and joints to plans: coupled bodies become one plan, with points numbered body by body.
#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <numeric>

#include "taut/core/error.h"
#include "taut/plan/private/couplings.h"
#include "taut/plan/private/pins.h"
#include "taut/plan/private/strain_limit.h"
#include "taut/plan/private/ties.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

double airMassOf(const mechanics::Model& model, std::size_t k) {
    return model.airMasses.empty() ? 0.0 : model.airMasses[k];
}

// Merges two points: masses add, drag is weighted by mass, momentum is kept, held if either is.
void weldOnto(IslandPlan& plan, int island, const mechanics::Model& model, std::size_t k) {
    auto& point = plan.points[island];
    dvec3& velocity = plan.velocities[island];
    const double mass = point.mass + model.masses[k];
    velocity = (point.mass * velocity + model.masses[k] * model.velocities[k]) / mass;
    point.dragRate = (point.mass * point.dragRate + model.masses[k] * model.dragRates[k]) / mass;
    point.mass = mass;
    point.airMass += airMassOf(model, k);
    point.held = point.held || model.held[k];
    if (point.held) velocity = dvec3(0.0);
}

// Grids and ropes are numbered well already. The points of a mesh are taken breadth first from one end of its
// longest side (Cuthill and McKee 1969), so that neighbours have close numbers.
std::vector<int> localOrder(const mechanics::Model& model) {
    std::vector<int> order(model.positions.size());
    std::iota(order.begin(), order.end(), 0);
    if (model.triangles.empty() || model.grid[0] > 0 || !model.cells.empty()) return order;
    std::vector<std::vector<int>> neighbours(model.positions.size());
    for (const mechanics::Spring& s : model.springs) {
        neighbours[s.a].push_back(s.b);
        neighbours[s.b].push_back(s.a);
    }
    dvec3 low = model.positions[0], high = low;
    for (const dvec3& x : model.positions) {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    std::vector<int> starts = order;
    std::stable_sort(starts.begin(), starts.end(),
                     [&](int a, int b) { return model.positions[a][axis] < model.positions[b][axis]; });
    std::vector<bool> seen(order.size(), false);
    order.clear();
    for (int start : starts) {
        if (seen[start]) continue;
        seen[start] = true;
        order.push_back(start);
        for (std::size_t next = order.size() - 1; next < order.size(); ++next) {
            std::vector<int>& around = neighbours[order[next]];
            std::sort(around.begin(), around.end());
            for (int i : around)
                if (!seen[i]) {
                    seen[i] = true;
                    order.push_back(i);
                }
        }
    }
    return order;
}

// The solver of all bodies of a plan.
SolverSpec solverOf(const IslandPlan& plan, const SceneSpec& scene) {
    SolverSpec solver = scene.solver;
    const auto same = [&](const Body& a, const Body& b) { return a.spec->solver == b.spec->solver; };
    const Body& first = *plan.bodies.front();
    for (const Body* other : plan.bodies)
        if (!same(first, *other))
            throw core::Error(core::ErrorKind::badContent,
                              at(other->spec->source) + other->fullName() + " and " + first.fullName() +
                                  " are joined but differ in their solver; give both the same `solver`");
    solver.integrator = first.spec->solver.integrator.value_or(solver.integrator);
    solver.safety = first.spec->solver.safety.value_or(solver.safety);
    if (first.spec->solver.dt) solver.dt = first.spec->solver.dt;
    solver.newtonSteps = first.spec->solver.newtonSteps.value_or(solver.newtonSteps);
    solver.cgTolerance = first.spec->solver.cgTolerance.value_or(solver.cgTolerance);
    solver.cgIterations = first.spec->solver.cgIterations.value_or(solver.cgIterations);
    return solver;
}

class Planner {
  public:
    Planner(std::span<Body* const> bodies, const SceneSpec& spec) : scene_(bodies), spec_(spec), coupled_(scene_) {
        int number = 0;
        const std::vector<std::array<SeamRow, 2>> rows = rowsOfSeams(scene_, spec);
        auto next = rows.begin();
        for (const JointSpec& joint : spec.joints) {
            if (joint.isSeam())
                addSeam(joint, number, *next++, scene_, coupled_);
            else if (!isTie(joint))
                addJoint(joint, number, scene_, coupled_);
            ++number;
        }
        markSeamCorners(scene_, coupled_);
    }

    std::vector<IslandPlan> plans() {
        std::vector<std::vector<int>> members(scene_.bodies().size());  // by the body that represents the set
        for (int body = 0; body < static_cast<int>(scene_.bodies().size()); ++body)
            members[coupled_.islands.find(body)].push_back(body);
        std::vector<std::vector<JointPair>> joints(scene_.bodies().size());
        for (const JointPair& joint : coupled_.pairs)
            joints[coupled_.islands.find(scene_.refOf(joint.a.nearest()).body)].push_back(joint);
        std::vector<int> numberOf(scene_.count(), -1);  // by the global point that represents a weld
        std::vector<IslandPlan> plans;
        for (std::size_t root = 0; root < members.size(); ++root)
            if (!members[root].empty()) plans.push_back(plan(members[root], joints[root], numberOf));
        return plans;
    }

    const std::vector<JointReport>& reports() const { return coupled_.reports; }

  private:
    IslandPlan plan(const std::vector<int>& members, const std::vector<JointPair>& joints, std::vector<int>& numberOf) {
        IslandPlan plan;
        for (int body : members) addBody(plan, body, numberOf);
        const std::vector<int> solidOf = solidsOf(plan, members, scene_, coupled_);
        for (const bool isWeld : {true, false})  // welds first, as they move points
            for (const JointPair& joint : joints)
                if (joint.spec->isWeld() == isWeld) tie(plan, joint, solidOf);
        Pins::settle(plan);
        addSolids(plan, members, scene_, coupled_);
        plan.origins.resize(plan.springs.size());
        plan.broken.resize(plan.springs.size(), false);
        if (StrainLimit::isIn(plan)) plan.constraints.push_back(std::make_shared<StrainLimit>(plan));
        plan.solver = solverOf(plan, spec_);
        return plan;
    }

    // Points of one solid do not move against each other: their ties are left out, as no force could satisfy them.
    void tie(IslandPlan& plan, const JointPair& joint, const std::vector<int>& solidOf) {
        const auto ofPlan = [&](int number) { return scene_.pointOf(scene_.refOf(number)); };
        const Spot a = joint.a.renumbered(ofPlan), b = joint.b.renumbered(ofPlan);
        const int solid = solidOf[a.nearest()];
        if (solid >= 0 && solid == solidOf[b.nearest()]) {
            for (JointReport& report : coupled_.reports)
                if (report.spec == joint.spec) ++report.idle;
            return;
        }
        addTie(plan,
               {.joint = joint.number,
                .a = a.nearest(),
                .b = b.nearest(),
                .breakForce = joint.spec->breakForce.value_or(HUGE_VAL),
                .from = a,
                .to = b,
                .isSeam = joint.spec->isSeam(),
                .touch = joint.spec->touch},
               [&] {
                   if (joint.spec->isMounted())
                       joint.spec->mount(plan, mountingOf(joint, scene_));
                   else
                       joint.spec->tie(plan, a, b, joint.distance);
               });
    }

    void addBody(IslandPlan& plan, int number, std::vector<int>& numberOf) {
        Body& b = scene_.body(number);
        const mechanics::Model& model = b.model;
        b.firstPoint = static_cast<int>(plan.points.size());
        b.pointOf.assign(model.positions.size(), -1);
        bool whole = true;
        for (int i : localOrder(model)) {
            const auto k = static_cast<std::size_t>(i);
            int& island = numberOf[coupled_.welds.find(scene_.global({number, i}))];
            if (island < 0) {
                island = static_cast<int>(plan.points.size());
                plan.points.push_back({model.masses[k], model.dragRates[k], model.held[k], airMassOf(model, k)});
                plan.positions.push_back(model.positions[k]);
                plan.velocities.push_back(model.velocities[k]);
            } else {
                weldOnto(plan, island, model, k);
                // Points welded to a point of a solid move to it, so that the solid keeps its shape.
                if (b.spec->isRigid()) plan.positions[island] = model.positions[k];
                whole = false;
            }
            b.pointOf[k] = island;
        }
        b.lastPoint = static_cast<int>(plan.points.size());
        const int row = model.grid[0] > 0 ? model.grid[0] + 1 : 0;
        if (b.lastPoint > b.firstPoint) plan.ranges.push_back({b.firstPoint, whole ? row : 0});
        for (std::size_t i = 0; i < model.springs.size(); ++i) {
            mechanics::Spring spring = model.springs[i];
            spring.a = b.pointOf[spring.a];
            spring.b = b.pointOf[spring.b];
            if (spring.a == spring.b) continue;
            plan.springs.push_back(spring);
            plan.origins.push_back({static_cast<int>(plan.bodies.size()), static_cast<int>(i)});
        }
        plan.bodies.push_back(&b);
    }

    ScenePoints scene_;
    const SceneSpec& spec_;
    Couplings coupled_;
};

}  // namespace

std::vector<IslandPlan> planIslands(std::span<Body* const> bodies, const SceneSpec& spec,
                                    std::vector<JointReport>* joints) {
    if (bodies.empty()) return {};
    Planner planner(bodies, spec);
    std::vector<IslandPlan> plans = planner.plans();
    if (joints != nullptr) *joints = planner.reports();
    return plans;
}

}  // namespace taut::world
