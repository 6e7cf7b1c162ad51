// The plan from which an island is built: the bodies that move together, with their points and springs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/body/body.h"
#include "taut/body/spot.h"
#include "taut/core/value.h"
#include "taut/mechanics/bending_elements.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/pose_path.h"
#include "taut/ode/method_table.h"

namespace taut::world {

class Constraint;
struct JointSpec;

// Where a spring of an island comes from.
struct SpringOrigin {
    int body = -1;    // of the plan's bodies; -1: a joint
    int spring = -1;  // of that body's model
};

// The points that a hand or a collider holds. They keep their places relative to it and turn with it.
struct Grip {
    TAUT_VALUE(Grip);
    std::string holder;                      // the hand, or "collider.pole"
    bool ofCollider = false;                 // whether the holder is a collider
    bool rigid = false;                      // points follow exactly; else springs draw them
    std::vector<int> points;                 // ascending
    std::vector<dvec3> offsets;              // (points) [m] from the holder, as it is unturned
    std::vector<double> stiffness, damping;  // (points) [N/m], [kg/s]; empty for rigid grips
    std::vector<double> mostForce;           // (points) [N] > 0; empty: no limit
    std::vector<double> lengths;             // (points) [m] of the springs; empty: none has any
    mechanics::PosePath path;                // of the holder; its place moves on a line during each tick
    int tie = -1;                            // of the plan, if the grip belongs to this tie alone; -1: to none
};

// A collider that constraints are fixed to.
struct Carrier {
    std::string collider;      // "collider.pole"
    mechanics::PosePath path;  // as in Grip
};

// One pair that a joint ties: two points, or a point and a place on a collider. It holds as long as any of the springs,
// constraints or grips that its kind made for it does.
struct JointTie {
    int joint = -1;                // of the scene's joints
    int a = -1, b = -1;            // points at its ends or next to them; b is -1 for a collider
    std::string collider{};        // "collider.pole", or empty
    dvec3 offset{0.0};             // [m] of the place, from the unturned collider
    double breakForce = HUGE_VAL;  // [N]
    Spot from = -1, to = -1;       // the places of its ends
    bool isSeam = false;           // the cells at both points do not touch each other
    bool touch = false;            // its rigid bodies, or its body and its collider, touch each other
    std::vector<int> springs{};    // of the plan
    struct Part {
        int constraint, tie;  // number in the plan, and number within the constraint
    };
    std::vector<Part> parts{};
    bool isGrip = false;  // it is a grip or part of one
    bool has(const Part& part) const {
        return std::any_of(
            parts.begin(), parts.end(),
            [&](const Part& own) { return own.constraint == part.constraint && own.tie == part.tie; });
    }
};

// Points have the island's own numbers: body by body, welded points once.
struct IslandPlan {
    TAUT_VALUE(IslandPlan);
    std::vector<Body*> bodies;
    SolverSpec solver;
    std::vector<dvec3> positions, velocities;  // (points)
    std::vector<mechanics::PointMass> points;
    std::vector<mechanics::PointRange> ranges;                   // (bodies)
    std::vector<mechanics::Spring> springs;                      // joints last
    std::vector<SpringOrigin> origins;                           // (springs)
    std::vector<bool> broken;                                    // (springs) cut or torn; these have no stiffness
    std::vector<Grip> grips;                                     // in the order of grabbing
    std::vector<std::shared_ptr<const Constraint>> constraints;  // shared: to change one, replace it
    std::vector<Carrier> carriers;                               // of the places of constraints, each collider once
    std::vector<JointTie> ties;                                  // of joints, without welds that merge bodies or points
    std::vector<std::vector<const Body*>> solids;                // groups of rigid bodies that move as one
};

// The result of a joint of the scene.
struct JointReport {
    TAUT_VALUE(JointReport);
    const JointSpec* spec = nullptr;
    struct Pair {
        const Body *a, *b;  // bodies of its two sides
        int points;         // number of points of a joined to b
    };
    std::vector<Pair> pairs;  // in the order of the bodies
    double jump = 0;          // [m] largest distance of places that it makes one
    int idle = 0;             // number of its ties between points of one solid, which are left out
    struct Sewn {
        std::array<double, 2> lengths{};  // [m] of its two edges
        double gap = 0;                   // [m] the largest in an edge of several, which no seam closes
        double apart = 0;                 // [m] largest distance of points that it sews
        int heldApart = 0;                // pairs of points that are held, and not in one place
    };
    Sewn sewn;                                          // of a seam
    std::vector<std::pair<const Body*, double>> loose;  // bodies that it names but does not join; smallest distance [m]
};

// The smallest sets of bodies that springs or welds couple. Fills pointOf, firstPoint and lastPoint of every body, and,
// if wanted, the result of each joint. Throws core::Error(badContent) where joints name nothing or where bodies that
// are tied together disagree on their solver. ties.h handles joints with colliders.
std::vector<IslandPlan> planIslands(std::span<Body* const> bodies, const SceneSpec& spec,
                                    std::vector<JointReport>* joints = nullptr);

// Adds a tie of all that `add` adds to the plan. Adds no tie if that is nothing.
void addTie(IslandPlan& plan, JointTie tie, const std::function<void()>& add);
bool holds(const IslandPlan& plan, const JointTie& tie);
// Takes a tie out of the plan if it holds. Returns whether it did.
bool letGo(IslandPlan& plan, std::size_t tie);

// Records that a place of a constraint is fixed to this collider, which moves on this path.
void carryBy(IslandPlan& plan, const std::string& collider, const mechanics::PosePath& path);
// Its path. Expects that a place of a constraint is fixed to it.
const mechanics::PosePath& pathOf(const IslandPlan& plan, const std::string& collider);

// Takes stiffness, damping and drag from the models of the bodies again, for instance after a change.
void takeSpringsFromModels(IslandPlan& plan);

// The table of methods that has the solver's integrator.
const ode::Methods& methodsOf(const SolverSpec& solver);

// (points) [1/kg], 0 for held points.
std::vector<double> inverseMassesOf(const IslandPlan& plan);
// The cells left of a body, or of all bodies of the plan, in points of the island.
std::vector<mechanics::VolumeCell> cellsOf(const Body& body);
std::vector<mechanics::VolumeCell> cellsOf(const IslandPlan& plan);
// The present bending of a body: without cut or torn parts, with the direction of clamped points held while the points
// are. Of a grid or a straight rope, of the friction of a grid's threads, and of all else; each empty for a body that
// has another or none.
mechanics::Bending gridBendingOf(const IslandPlan& plan, const Body& body);
mechanics::BendingFriction gridFrictionOf(const IslandPlan& plan, const Body& body);
std::vector<mechanics::BendingElement> bendingElementsOf(const IslandPlan& plan, const Body& body);
// The body of a point and the point's number in it; for a weld the first of its bodies. Null and the point itself if no
// body has it.
std::pair<const Body*, int> authored(const IslandPlan& plan, int point);
// Whether a collider carries a point by a constraint.
bool isPinned(const IslandPlan& plan, int point);
// (points) whether it is held, in place or on a collider.
std::vector<bool> heldPointsOf(const IslandPlan& plan);
// Whether a point moves by itself: neither held nor in a rigid grip.
bool isFree(const IslandPlan& plan, int point);
// [m] Length of a spring between points at x (points) [m].
double lengthOf(const mechanics::Spring& spring, std::span<const dvec3> x);

// "structural spring 12-13 of cloth.flag" for spring number `spring` of the plan.
std::string describeSpring(const IslandPlan& plan, int spring);

}  // namespace taut::world
