// What a scene asks of bodies that touch and hardly means: found before the first tick.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace taut::world {

class ContactStage;
class World;

// Bodies that go through each other or themselves as they start, or lie in one place, `touch` without anything to
// touch, thickness above the cell. Expects a world that has not ticked.
std::vector<std::string> touchDoubts(World& world);

// Of pairs of surfaces the points of either that lie in the other, so near that nothing says which is to go to which
// side. Expects that crossings have been looked for.
std::map<std::pair<int, int>, std::set<int>> pointsInOnePlace(const ContactStage& stage);

}  // namespace taut::world
