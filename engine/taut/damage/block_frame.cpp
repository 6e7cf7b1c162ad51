#include "taut/damage/private/block_frame.h"

#include <utility>

#include "taut/spec/private/rotation.h"

namespace taut::world {

BlockFrame::BlockFrame(std::shared_ptr<const mechanics::Lattice> lattice, const dvec3& first, const glm::dquat& turn)
    : lattice_(std::move(lattice)), first_(first), turn_(turn) {}

dvec3 BlockFrame::inside(const dvec3& place) const {
    dvec3 local = lattice_->cell * dvec3(lattice_->points.front());
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 unit(0.0);
        unit[axis] = 1.0;
        local[axis] += glm::dot(place - first_, rotated(turn_, unit));
    }
    return local;
}

dvec3 BlockFrame::place(const dvec3& inside) const {
    return first_ + rotated(turn_, inside - lattice_->cell * dvec3(lattice_->points.front()));
}

}  // namespace taut::world
