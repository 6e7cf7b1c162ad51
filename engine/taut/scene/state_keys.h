// What a state and its picture have been made by, as numbers to compare: so that a stored state is not taken for that
// of another scene. It knows what of a file reaches the state; it does not know how the state comes about.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "taut/fields/node.h"

namespace taut::world {
struct SceneSpec;
}  // namespace taut::world

namespace taut::scene {

using fields::Node;

class StateKeys {
  public:
    StateKeys() = default;
    // Of a whole document, overrides applied, and of what it was read as.
    StateKeys(const Node& root, const world::SceneSpec& spec);

    // Of the state at a tick: everything in the scene but what only pictures show, and the actions of the ticks before.
    // The steps that a world chose with an eye on later actions are not in it.
    std::uint64_t stateAt(std::int64_t tick) const;

    // Of what only pictures show: camera, light, finish, labels, …
    std::uint64_t picture() const { return picture_; }

  private:
    std::uint64_t scene_ = 0, picture_ = 0;
    std::vector<std::pair<std::int64_t, std::uint64_t>> actions_;  // tick and what is done, in the order of doing
};

}  // namespace taut::scene
