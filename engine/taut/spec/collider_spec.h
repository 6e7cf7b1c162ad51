// Rigid things that stop bodies.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/spec/finish_spec.h"
#include "taut/spec/mesh_data.h"
#include "taut/spec/source.h"

namespace taut::world {

struct PoseKey {
    double t = 0.0;            // [s]
    dvec3 position{0.0};       // [m]
    dvec3 rotation{0.0};       // [rad]
    Ease ease = Ease::smooth;  // on the way from the previous key to this one
};

struct ColliderSpec : MeshSource {  // the file: of a hull, a mesh, a figure
    TAUT_VALUE(ColliderSpec);
    std::string name;
    Source source;
    std::string shape = "sphere";  // a name from the table of shapes (collision/shape_table.h), or compound
    dvec3 position{0.0};           // [m]
    dvec3 rotation{0.0};           // [rad]
    dvec3 normal{0.0, 1.0, 0.0};   // plane
    dvec3 size{1.0};               // box: whole edges [m]
    double radius = 0.5;           // [m]
    double height = 1.0;           // [m] cylinder, cone: whole; capsule: between the centres of its half spheres
    std::map<std::string, double, std::less<>> sizes;  // further sizes of the shape, by key
    double scale = 1.0;
    std::string animation;            // of a figure; empty: as it stands at rest
    double start = 0.0;               // [s] of the animation at the start of the scene
    double speed = 1.0;               // of the animation [-]
    bool loops = true;                // the animation begins again; else it stays at its end
    std::vector<ColliderSpec> parts;  // compound
    double friction = 0.3;            // Coulomb's μ [-]
    double restitution = 0.0;         // 0 … 1: speed after a bounce / speed before [-]
    std::vector<PoseKey> keys;        // keyframes; position and rotation are unused then
    bool visible = true;
    double edge = 0.01;  // [m] rounding of a drawn box's edges
    FinishSpec finish;
    // Of a part; none: that of the compound. Of a figure; none: the colours of its file.
    std::optional<FinishSpec> ownFinish;
};

}  // namespace taut::world
