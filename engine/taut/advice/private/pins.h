// Where a sheet or a block that can tear or yield is held or loaded at a single point: the strain beside it grows as
// the cells shrink, so that what happens there depends on them.
#pragma once

#include <set>
#include <string>
#include <vector>


namespace taut::world {

class World;

class Pins {
  public:
    // Looks at the world as it is now: what is held, grabbed, tied, or weighed down by a mass of the scene.
    void look(World& world);
    // One for each body that was found so, in the order of finding.
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    std::set<std::string> seen_;  // bodies
    std::vector<std::string> warnings_;
};

}  // namespace taut::world
