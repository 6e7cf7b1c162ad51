// Reads actions for a world that runs already, as the timeline of its scene would have them.
#pragma once

#include <memory>
#include <string>

#include "taut/fields/node.h"
#include "taut/spec/actions.h"
#include "taut/spec/kinds.h"

namespace taut::scene {

class ActionReader {
  public:
    // Of the document that the scene was read from.
    ActionReader(fields::Node root, world::Kinds kinds) : root_(std::move(root)), kinds_(std::move(kinds)) {}

    // An action of now, t [s], as TOML without its moment: `{ do = "push", target = "cloth.flag", impulse_Ns = [1, 0,
    // 0]
    // }`. Throws core::Error(badContent), "LABEL: error: …", for everything that is wrong with it by itself; what it
    // finds of hands, bodies and colliders it says when it is performed.
    std::unique_ptr<world::ActionSpec> read(const std::string& table, double t, const std::string& label,
                                            const world::SceneSpec& spec) const;

    // What World::restore() has to know of a ramp that was applied. Throws core::Error(badContent) for a key that may
    // not change.
    world::RampAction ramp(const std::string& key, const world::SceneSpec& spec) const;

  private:
    fields::Node root_;
    world::Kinds kinds_;
};

}  // namespace taut::scene
