// The stiffest and fastest state that a timeline will make of an island. A step chosen for it before the first tick
// holds through the whole run. It knows no method.
#pragma once

#include <memory>
#include <vector>

#include "taut/forces/force.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

struct Envelope {
    // The island as built, with the stiffest springs and lightest masses, and with every point free that is ever free.
    IslandPlan plan;
    ForceList forces;                           // at their strongest
    std::vector<double> handStiffness;          // (points) [N/m] of all hands that may hold the point at one time
    std::vector<double> handRate;               // (points) [1/s] damping of the point by these hands
    double leastTau = 0;                        // [s] smallest value of its largest spring damping time
    double leastDrag = 0, mostDrag = 0;         // [1/s] over points that are ever free
    bool isStatic = true;                       // plan and forces are those of the island itself
    std::vector<std::shared_ptr<Body>> bodies;  // of the plan, where they are not the island's own bodies
};

// [s] largest damping time of its springs.
double largestTau(const IslandPlan& plan);

// The share of a hand in ω² [1/s²] and in the damping [1/s] of each point of its grip: K/M and 2ζ√(K/M). K is the
// strength of the hand [N/m], M the mass of the grip [kg]. Both are the same for all points, since they share by mass.
struct GripRates {
    double omega2 = 0, damping = 0;
};
GripRates gripRates(double strength, double dampingRatio, double mass);

// Whether the timeline spawns the body later.
bool isSpawnedLater(const Body& body, const SceneSpec& spec);

// The envelopes of the islands of a scene.
class Envelopes {
  public:
    explicit Envelopes(const SceneSpec& spec);
    ~Envelopes();
    // Of an island of the scene's bodies with all its joints, or of a body that came later, without joints. A body that
    // the scene does not name is taken as it is. Throws core::Error(badContent) where a timeline takes all mass from a
    // point.
    Envelope of(const IslandPlan& plan, const ForceList& forces, bool hasJoints) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::world
