// The places of keyframed things at a time: colliders and cameras.
#pragma once

#include <span>

#include "taut/collision/colliders.h"
#include "taut/spec/collider_spec.h"
#include "taut/spec/picture_spec.h"
#include "taut/view/frame_view.h"

namespace taut::world {

// Share of the way after a share u of the time, both 0 … 1.
double eased(Ease ease, double u);

// The pose of a collider by its keyframes, or else its fixed position and rotation. Same bits on every machine.
collision::Pose poseAt(const ColliderSpec& spec, double t);

view::Camera cameraAt(const CameraSpec& spec, double t);

// A pose at a share 0 … 1 of the way from one to another. The rotation goes the short way round.
collision::Pose between(const collision::Pose& from, const collision::Pose& to, double part);

}  // namespace taut::world
