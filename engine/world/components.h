// What an entity of the world can have.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "collision/colliders.h"
#include "world/body.h"
#include "world/drawing.h"
#include "world/spec.h"

namespace taut::world {

struct Identity {
    std::string kind;  // "cloth", "collider", "camera", …
    std::string name;
    std::string fullName() const { return kind + "." + name; }
};

// A rope, cloth, block or net.
struct BodyPart {
    std::unique_ptr<Body> body;
    std::unique_ptr<BodyDrawing> drawing;
};

// Where a rigid thing is at the start and the end of the current tick. A system that moves it writes `to`.
struct Placement {
    collision::Pose from, to;
    bool moved = false;  // in the tick before
};

struct ColliderPart {
    ColliderSpec spec;
    std::shared_ptr<const ColliderModel> model;
};

struct WindPart {
    WindSpec spec;
};
struct AnchorPart {
    AnchorSpec spec;
};
struct CameraPart {
    CameraSpec spec;
};

}  // namespace taut::world
