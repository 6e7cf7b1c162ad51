// How a tie of a joint is drawn, as the scene says: a cord, a coil or a ball.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/spec/joint_spec.h"
#include "taut/view/frame_view.h"

namespace taut::world {

class TieDrawing {
  public:
    // Expects a joint that is drawn. Its number stands in for a missing name.
    TieDrawing(const JointSpec& joint, int number);
    const std::string& name() const { return name_; }  // "joint.peg"
    // A coil shorter than it is wide shows nothing.
    bool isShown(const glm::vec3& a, const glm::vec3& b) const;
    // The surface from end to end [m]. A tie that may be released has a name of its own; `number` counts the ties
    // of the name.
    view::Surface surface(const glm::vec3& a, const glm::vec3& b, int number) const;

  private:
    // The curve that it follows.
    std::vector<glm::vec3> line(const glm::vec3& a, const glm::vec3& b) const;

    std::string name_;
    bool mayLetGo_;
    JointLook look_;
    std::shared_ptr<const view::Finish> finish_;
    std::shared_ptr<const view::Topology> topology_;
};

}  // namespace taut::world
