// Rigid things that stop bodies.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/turn_friction.h"
#include "taut/core/value.h"
#include "taut/spec/finish_spec.h"
#include "taut/spec/shape_spec.h"
#include "taut/spec/source.h"

namespace taut::world {

struct PoseKey {
    double t = 0.0;            // [s]
    dvec3 position{0.0};       // [m]
    dvec3 rotation{0.0};       // [rad]
    Ease ease = Ease::smooth;  // on the way from the previous key to this one
};

struct ColliderSpec : ShapeSpec {
    TAUT_VALUE(ColliderSpec);
    std::string name;
    Source source;
    dvec3 normal{0.0, 1.0, 0.0};      // plane
    std::string animation;            // of a figure; empty: as it stands at rest
    double start = 0.0;               // [s] of the animation at the start of the scene
    double speed = 1.0;               // of the animation [-]
    bool loops = true;                // the animation begins again; else it stays at its end
    std::vector<ColliderSpec> parts;  // compound
    double friction = 0.3;            // Coulomb's μ [-]
    double restitution = 0.0;         // 0 … 1: speed after a bounce / speed before [-]
    core::TurnFriction turnFriction;
    std::vector<PoseKey> keys;  // keyframes; position and rotation are unused then
    bool visible = true;
    FinishSpec finish;
    // Of a part; none: that of the compound. Of a figure; none: the colours of its file.
    std::optional<FinishSpec> ownFinish;
};

}  // namespace taut::world
