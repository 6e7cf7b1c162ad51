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
    // Expects a joint that is drawn; its number stands for a name.
    TieDrawing(const JointSpec& joint, int number);
    const std::string& name() const { return name_; }  // "joint.peg"
    // From end to end [m]. What may let go is a thing by itself, by its number among those of the name.
    view::Surface surface(const glm::vec3& a, const glm::vec3& b, int number) const;

  private:
    // The line that it goes along.
    std::vector<glm::vec3> line(const glm::vec3& a, const glm::vec3& b) const;

    std::string name_;
    bool mayLetGo_;
    JointLook look_;
    std::shared_ptr<const view::Finish> finish_;
    std::shared_ptr<const view::Topology> topology_;
};

}  // namespace taut::world
