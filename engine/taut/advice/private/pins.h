// Finds sheets and blocks that can tear or yield and are held or loaded at a single point. The strain beside such a
// point grows as the cells shrink, so the result depends on the cells.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "taut/core/finding.h"

namespace taut::world {

class World;

class RehearsedPins {
  public:
    // Looks at the present world: points that are held, grabbed, tied, or weighed down by a mass of the scene.
    void look(World& world);
    // One for each body found, in the order of finding.
    const std::vector<core::Finding>& warnings() const { return warnings_; }

  private:
    std::set<std::string> seen_;  // bodies
    std::vector<core::Finding> warnings_;
};

}  // namespace taut::world
