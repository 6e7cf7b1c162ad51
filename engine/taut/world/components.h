// Components of entities of the world.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "taut/body/body.h"
#include "taut/collision/colliders.h"
#include "taut/drawing/drawing.h"
#include "taut/ecs/registry.h"
#include "taut/spec/collider_spec.h"
#include "taut/spec/picture_spec.h"

namespace taut::world {

struct Identity {
    std::string kind;  // "cloth", "collider", "camera", …
    std::string name;
    std::string fullName() const { return kind + "." + name; }
};

// A body: it moves by forces.
struct BodyPart {
    std::unique_ptr<Body> body;
    std::unique_ptr<BodyDrawing> drawing;
    std::size_t drawnDamage = 0;  // number of severed edges in the drawing
};

// The place of a rigid thing at the start and the end of the current tick. A system that moves the thing writes `to`.
struct Placement {
    collision::Pose from, to;
    bool moved = false;  // in the previous tick
};

// A motion that an action gives a collider; times in ticks.
struct PoseMove {
    collision::Pose from, to;
    std::int64_t start = 0, length = 1;
    Ease ease = Ease::smooth;
};

struct ColliderPart {
    ColliderSpec spec;
    std::shared_ptr<const ColliderModel> model;
    std::optional<PoseMove> move{};  // the last one; if set, keyframes no longer count
};

struct CameraPart {
    CameraSpec spec;
    // How it follows bodies.
    std::optional<dvec3> followedFrom{};  // [m] middle of their points when first seen
    dvec3 moved{0.0}, movingAt{0.0};      // [m] that the camera has gone since, and how fast it goes on [m/s]
};

// At a time [s], `ahead` [s] of the tick.
view::Camera cameraOf(const CameraPart& part, double time, double ahead = 0.0);

}  // namespace taut::world
