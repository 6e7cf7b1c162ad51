// Which bodies move together, and with which points and springs: the plan from which an island is built.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/pose_path.h"
#include "taut/ode/method_table.h"
#include "taut/bodies/body.h"

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
    std::string holder;                      // the hand, or "collider.pole"
    bool ofCollider = false;                 // which of the two
    bool rigid = false;                      // led exactly; else drawn by springs
    std::vector<int> points;                 // ascending
    std::vector<dvec3> offsets;              // (points) [m] from it, as it is unturned
    std::vector<double> stiffness, damping;  // (points) [N/m], [kg/s]; not of rigid ones
    std::vector<double> mostForce;           // (points) [N] > 0; empty: any
    mechanics::PosePath path;                // of it; the place on a line during each tick
    int tie = -1;                            // of the plan, whose it is alone; -1: of none
};

// A collider that constraints are fixed to.
struct Carrier {
    std::string collider;      // "collider.pole"
    mechanics::PosePath path;  // as of a Grip
};

// One pair of what a joint ties: two points, or a point and a place on a collider. It holds as long as anything that its
// kind made of it does.
struct JointTie {
    int joint = -1;         // of the scene
    int a = -1, b = -1;     // points; b -1: a collider
    std::string collider{};   // "collider.pole", or empty
    dvec3 offset{0.0};      // [m] of the place, from the collider as it is unturned
    double breakForce = HUGE_VAL;  // [N]
    std::vector<int> springs{};    // of the plan
    struct Part {
        int constraint, tie;  // of the plan, and of it
    };
    std::vector<Part> parts{};
    bool isGrip = false;  // or part of one
};

// Points in the island's own numbering: body by body, welded points once.
struct IslandPlan {
    std::vector<Body*> bodies;
    SolverSpec solver;
    std::vector<dvec3> positions, velocities;  // (points)
    std::vector<mechanics::PointMass> points;
    std::vector<mechanics::PointRange> ranges;  // (bodies)
    std::vector<mechanics::Spring> springs;     // joints last
    std::vector<SpringOrigin> origins;          // (springs)
    std::vector<bool> broken;                   // (springs) cut or torn; then without stiffness
    std::vector<Grip> grips;                    // in the order of grabbing
    std::vector<std::shared_ptr<const Constraint>> constraints;  // another takes the place of one that changes
    std::vector<Carrier> carriers;                               // of their places, each once
    std::vector<JointTie> ties;                                  // of joints, but for points that are merged
};

// What a joint of the scene has become.
struct JointReport {
    const JointSpec* spec = nullptr;
    struct Pair {
        const Body *a, *b;  // of its two sides
        int points;         // of a that are joined to b
    };
    std::vector<Pair> pairs;                            // in the order of the bodies
    double jump = 0;                                    // [m] largest distance of points that were welded
    std::vector<std::pair<const Body*, double>> loose;  // bodies that it names and does not join, and how far off [m]
};

// The smallest sets of bodies that springs or welds couple. Fills pointOf, firstPoint and lastPoint of every body, and,
// if wanted, what became of each joint. Throws core::Error(badContent) where joints name nothing or bodies tied
// together disagree on their solver. Joints with colliders are not its concern, see ties.h.
std::vector<IslandPlan> planIslands(std::span<Body* const> bodies, const SceneSpec& spec,
                                    std::vector<JointReport>* joints = nullptr);

// Adds a tie, made of what `add` adds to the plan; none if that is nothing.
void addTie(IslandPlan& plan, JointTie tie, const std::function<void()>& add);
bool holds(const IslandPlan& plan, const JointTie& tie);
// Takes a tie out of the plan, if it holds. Returns whether it did.
bool letGo(IslandPlan& plan, std::size_t tie);

// Records that a place of a constraint is fixed to this collider, which moves on this path.
void carryBy(IslandPlan& plan, const std::string& collider, const mechanics::PosePath& path);

// Takes stiffness, damping and drag over from the models of the bodies, for instance when those have changed.
void takeSpringsFromModels(IslandPlan& plan);

// The table of methods that the solver's integrator is a name of.
const ode::Methods& methodsOf(const SolverSpec& solver);

// (points) [1/kg], 0 where held.
std::vector<double> inverseMassesOf(const IslandPlan& plan);
// The cells that are left of a body, or of all bodies of the plan, by points of the island.
std::vector<mechanics::VolumeCell> cellsOf(const Body& body);
std::vector<mechanics::VolumeCell> cellsOf(const IslandPlan& plan);
// How a body bends as it is now: without what is cut or torn, with directions held where its points are.
mechanics::Bending bendingOf(const IslandPlan& plan, const Body& body);
// The body of a point and the point's number there; of welded bodies the first. Null and the point itself if no body
// has it.
std::pair<const Body*, int> authored(const IslandPlan& plan, int point);
// Whether a collider carries a point by a constraint.
bool isPinned(const IslandPlan& plan, int point);
// (points) whether it is held, in place or on a collider.
std::vector<bool> heldPointsOf(const IslandPlan& plan);
// Whether a point moves by itself: neither held nor in a rigid grip.
bool isFree(const IslandPlan& plan, int point);
// [m] of a spring between points (points) of such a place [m].
double lengthOf(const mechanics::Spring& spring, std::span<const dvec3> x);

// "structural spring 12-13 of cloth.flag" for spring number `spring` of the plan.
std::string describeSpring(const IslandPlan& plan, int spring);

}  // namespace taut::world
