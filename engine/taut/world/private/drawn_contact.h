// Keeps surfaces that are drawn finer than they are computed out of colliders.
#pragma once

#include <cstdint>
#include <span>

#include "taut/collision/colliders.h"
#include "taut/view/frame_view.h"

namespace taut::world {

// Moves vertices so that no triangle of a sheet is in a collider, up to three thicknesses [m] deep; deeper ones are
// there on purpose. Nothing moves that is half a thickness away. Moves without a jump where the sheet and the colliders
// do. Normals stay those of the smooth surface.
void keepOutside(const collision::Colliders& colliders, double thickness, std::span<const std::uint32_t> triangles,
                 view::Geometry& geometry);

}  // namespace taut::world
