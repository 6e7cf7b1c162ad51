// The effects of the joints of a scene on its bodies, before they are planned: which bodies and points they couple.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "taut/plan/island_plan.h"
#include "taut/plan/mounting.h"
#include "taut/plan/private/scene_points.h"
#include "taut/plan/private/seam_pairing.h"
#include "taut/spec/joint_spec.h"

namespace taut::world {

// Disjoint sets with path halving. The smallest member represents its set.
class Sets {
  public:
    explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (parent_[i] != i) {
            int& up = parent_[i];
            up = parent_[up];
            i = up;
        }
        return i;
    }
    void unite(int a, int b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<int> parent_;
};

// One pair that a joint ties.
struct JointPair {
    Spot a, b;  // in global numbers of points
    const JointSpec* spec;
    int number;       // of the scene's joints
    double distance;  // [m]
};

struct Couplings {
    explicit Couplings(const ScenePoints& scene)
        : islands(scene.bodies().size()), solids(scene.bodies().size()), welds(scene.count()) {}

    Sets islands;  // (bodies)
    Sets solids;   // (bodies) that are one rigid body
    Sets welds;    // (points of all bodies)
    std::vector<JointPair> pairs;
    std::vector<std::pair<PointRef, int>> carried;  // points, and the solids that carry them
    std::vector<JointReport> reports;               // (joints of the scene)
    std::vector<SewnPair> sewn;                     // of all seams, in global numbers of points
};

// joint_pairs.cpp: joints that tie each point of one side to the nearest of the other, or two bodies at a place. All of
// these throw core::Error(badContent) for a joint that ties nothing.
void addJoint(const JointSpec& joint, int ofScene, const ScenePoints& scene, Couplings& coupled);
Mounting mountingOf(const JointPair& pair, const ScenePoints& scene);

// seams.cpp: two rows of edges, which are paired by their share of the length.
// A side of a seam: its edges one after the other.
struct SeamRow {
    std::vector<PointRef> points;
    SewnEdge edge;
    double longest = 0;  // [m] from a point to the next
    double gap = 0;      // [m] between two edges one after the other, the largest that no seam closes
    double length() const { return std::accumulate(edge.steps.begin(), edge.steps.end(), 0.0); }
    void addStep(double length) {
        edge.steps.push_back(length);
        longest = std::max(longest, length);
    }
};
// The sides of all seams of a scene.
std::vector<std::array<SeamRow, 2>> rowsOfSeams(const ScenePoints& scene, const SceneSpec& spec);
void addSeam(const JointSpec& seam, int ofScene, const std::array<SeamRow, 2>& rows, const ScenePoints& scene,
             Couplings& coupled);
// Finds Body::seamCorners.
void markSeamCorners(const ScenePoints& scene, const Couplings& coupled);

// solids.cpp: welds of whole solids, and the constraints that keep solids rigid.
// Returns whether the weld is one of whole solids, which become one or carry the points of the other side.
bool addWholeSolids(const JointSpec& weld, const ScenePoints& scene, Couplings& coupled);
// Adds the solids of these bodies to their plan.
void addSolids(IslandPlan& plan, std::span<const int> members, const ScenePoints& scene, Couplings& coupled);
// (points of the plan) the solid that moves each, -1: none.
std::vector<int> solidsOf(const IslandPlan& plan, std::span<const int> members, const ScenePoints& scene,
                          Couplings& coupled);

}  // namespace taut::world
