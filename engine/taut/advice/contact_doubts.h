// Warnings about bodies with `touch`, found before the first tick: settings that are probably mistakes.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

class ContactStage;
class World;
struct WorldImpl;

// Bodies that pass through each other or themselves at the start, or lie in one place; solids in colliders or in each
// other; `touch` with nothing to touch; thickness above the cell size. Expects a world that has not ticked.
std::vector<core::Finding> touchDoubts(World& world);

// [m] The middle one of the three sizes of each collider but planes and figures: a post or a rod fits between points
// that are further apart.
std::map<std::string, double> colliderWidths(const WorldImpl& world);

// For pairs of surfaces: the points of either that lie in the other, so near that nothing tells which belongs on which
// side. Expects that crossings have been looked for.
std::map<std::pair<int, int>, std::set<int>> pointsInOnePlace(const ContactStage& stage);

}  // namespace taut::world
