// The cells of a block before anything moves. It knows no body.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "taut/mechanics/lattice.h"

namespace taut::world {

using glm::dvec3;

class BlockFrame {
  public:
    // first: [m] the first point of the lattice, in the scene. turn: from the axes of the block to those of the scene.
    BlockFrame(std::shared_ptr<const mechanics::Lattice> lattice, const dvec3& first, const glm::dquat& turn);

    const mechanics::Lattice& lattice() const { return *lattice_; }
    // A place [m] along the axes of the block, from the low corner of the box around its cells [m].
    dvec3 inside(const dvec3& place) const;
    dvec3 place(const dvec3& inside) const;  // the reverse

  private:
    std::shared_ptr<const mechanics::Lattice> lattice_;
    dvec3 first_;  // [m]
    glm::dquat turn_;
};

}  // namespace taut::world
