// Small deliberate errors in a scene or its picture: the tests of states and pictures must find them. It plays nothing.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "taut/island/report.h"
#include "taut/spec/spec.h"
#include "taut/view/frame_view.h"

namespace taut::regression {

// Either of a scene, which the chain of state hashes has to find, or of a picture, which its thresholds have to.
struct Mutant {
    std::string name;

    // The scene with the mistake; none when it has nothing to make it in. Islands are those of the right scene.
    std::function<std::optional<world::SceneSpec>(world::SceneSpec, const std::vector<world::IslandInfo>& islands)>
        ofScene{};

    // Of the picture: its view, or the renderer.
    std::function<void(view::FrameView& view, glm::ivec2 size)> ofView{};
    bool withoutShadows = false;

    bool isOfState() const { return static_cast<bool>(ofScene); }
};

// Twice the time step, a fifth less damping, one spring missing; the camera one pixel off, a fiftieth less of each
// light alone, a penumbra half as wide again, no shadows.
std::vector<Mutant> mutants();

}  // namespace taut::regression
