// Numbers that identify the inputs of a state and its picture, so that a stored state is not used for another scene. It
// uses the parts of a file that affect the state, and is independent of the computation of the state.
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
    // For a whole document with overrides applied, and the spec read from it.
    StateKeys(const Node& root, const world::SceneSpec& spec);

    // Key of the state at a tick: everything in the scene except the parts for pictures only, and the actions of
    // earlier ticks. It leaves out that a world chooses its steps with later actions in mind.
    std::uint64_t stateAt(std::int64_t tick) const;

    // Key of the parts for pictures only: camera, light, finish, labels, …
    std::uint64_t picture() const { return picture_; }

  private:
    std::uint64_t scene_ = 0, picture_ = 0;
    std::vector<std::pair<std::int64_t, std::uint64_t>> actions_;  // tick and content, in the order of happening
};

}  // namespace taut::scene
