// A camera that the user turns about its target and moves nearer. It knows no mouse.
#pragma once

#include <optional>

#include "taut/view/frame_view.h"

namespace taut::live {

// Follows the scene's camera until it is touched.
class Orbit {
  public:
    // Turns about the target, to the right and up [rad]. `from` is the scene's camera now.
    void turn(double right, double up, const view::Camera& from);
    // Multiplies the distance to the target.
    void zoom(double factor, const view::Camera& from);
    // Back to the scene's camera.
    void follow() { own_.reset(); }

    view::Camera camera(const view::Camera& ofScene) const { return own_.value_or(ofScene); }

  private:
    std::optional<view::Camera> own_;
};

}  // namespace taut::live
