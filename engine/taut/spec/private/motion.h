// Where keyframed things are at a time: colliders and cameras.
#pragma once

#include <span>

#include "taut/collision/colliders.h"
#include "taut/view/frame_view.h"
#include "taut/spec/collider_spec.h"
#include "taut/spec/picture_spec.h"

namespace taut::world {

// Share of the way after share u of the time, both 0 … 1, as animators name it.
double eased(Ease ease, double u);

// The pose of a collider: its keyframes, else its fixed position and rotation. Same bits on every machine.
collision::Pose poseAt(const ColliderSpec& spec, double t);

view::Camera cameraAt(const CameraSpec& spec, double t);

// Part of the way from one pose to another, 0 … 1; the rotation the short way round.
collision::Pose between(const collision::Pose& from, const collision::Pose& to, double part);

}  // namespace taut::world
