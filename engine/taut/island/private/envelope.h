// The stiffest and fastest that a timeline will make of an island, so that a step chosen before the first tick holds
// through all of it. It knows no method.
#pragma once

#include <memory>
#include <vector>

#include "taut/forces/force.h"
#include "taut/bodies/island_plan.h"

namespace taut::world {

struct Envelope {
    // The island as it is built, but with the stiffest springs, the lightest masses, and all points free that ever are.
    IslandPlan plan;
    ForceList forces;                           // at their strongest
    std::vector<double> handStiffness;          // (points) [N/m] of all hands that a point may be in at a time
    std::vector<double> handRate;               // (points) [1/s] at which they damp it
    double leastTau = 0;                        // [s] that the largest of its springs ever falls to
    double leastDrag = 0, mostDrag = 0;         // [1/s] of points that are ever free
    bool isStatic = true;                       // plan and forces are those of the island itself
    std::vector<std::shared_ptr<Body>> bodies;  // of the plan, where they are not the island's own
};

// [s] of its springs.
double largestTau(const IslandPlan& plan);

// What a hand adds to ω² [1/s²] and to the damping [1/s] of each point of its grip: K/M and 2ζ√(K/M), K its strength
// [N/m] and M the mass of the grip [kg], the same for all since they share both by mass.
struct GripRates {
    double omega2 = 0, damping = 0;
};
GripRates gripRates(double strength, double dampingRatio, double mass);

// Whether the timeline spawns the body, so that it is not there before.
bool isSpawnedLater(const Body& body, const SceneSpec& spec);

// The envelopes of the islands of a scene.
class Envelopes {
  public:
    explicit Envelopes(const SceneSpec& spec);
    ~Envelopes();
    // Of an island of bodies of the scene, with all its joints; or of a body that came later, without joints. A body
    // that the scene does not name is taken as it is. Throws core::Error(badContent) where a timeline takes all mass
    // from a point.
    Envelope of(const IslandPlan& plan, const ForceList& forces, bool hasJoints) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::world
