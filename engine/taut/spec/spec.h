// Description of a scene, as plain data with defaults. The loader fills it, the world is built from it; independent of
// files and pictures. SI units; colours are sRGB as an artist writes them, 0 … 1.
//
// The loader refuses values out of range (scene::manual() lists every range). Code that fills a scene must keep to the
// same ranges and words, because the world does not check them again. It does check that targets and materials exist.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/spec/action_spec.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/claim_spec.h"
#include "taut/spec/collider_spec.h"
#include "taut/spec/force_spec.h"
#include "taut/spec/joint_spec.h"
#include "taut/spec/picture_spec.h"
#include "taut/spec/run_spec.h"
#include "taut/spec/solver_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

template <class Base>
class KindTable;

struct WorldSpec {
    dvec3 gravity{0.0, -9.81, 0.0};    // [m/s²]
    double airDensity = 1.2;           // [kg/m³]
    double airPressure = 101325.0;     // [Pa]
    double sealedPressure = 101325.0;  // [Pa] of the air at the start; set by World
};

// For bodies that touch each other or themselves.
struct ContactSpec {
    double friction = 0.3;          // Coulomb's μ between two bodies, times the factors of the two [-]
    double restitution = 0.0;       // 0 … 1: speed after two bodies bounce / before, times the factors of the two [-]
    std::optional<int> detections;  // of possible contact pairs, in a tick; none: chosen from the speeds
};

// Limits of hands during a run. Steps allow for the timeline's own grabs without it.
struct HandSpec {
    bool anywhere = false;      // a hand may grab any point of any body, and every step allows for it
    double strength = 200.0;    // [N/m] largest of a hand
    double dampingRatio = 0.3;  // largest
};

struct MassSpec {  // mass added to points
    std::string target;
    double mass = 1.0;  // [kg] shared evenly among the target's points
    Source source;
};

struct SceneSpec {
    TAUT_VALUE(SceneSpec);
    std::string file;
    std::vector<std::string> bases;    // the files on which it builds, the nearest first
    std::vector<std::string> fabrics;  // the files of the library from which it takes materials
    std::string title;
    WorldSpec world;
    ContactSpec contact;
    SolverSpec solver;
    RunSpec run;
    NeedSpec need;
    FitSpec fit;
    PictureSpec picture;
    LightSpec light;
    EnvironmentSpec environment;
    std::vector<LampSpec> lamps;
    BackgroundSpec background;
    std::map<std::string, MaterialSpec> materials;
    Specs<BodySpec> bodies;
    Specs<JointSpec> joints;       // in the order of the file
    std::vector<MassSpec> masses;  // in the order of the file
    std::vector<ColliderSpec> colliders;
    std::shared_ptr<const collision::ShapeKinds> shapes;  // of colliders and solids; none: the engine's own
    Specs<ForceSpec> forces;                              // in the order in which they are added
    std::vector<CameraSpec> cameras;
    std::vector<LabelSpec> labels;
    HandSpec hand;
    Specs<ActionSpec> actions;                                 // by time; at one moment in the order of the file
    std::shared_ptr<const KindTable<ActionSpec>> actionKinds;  // of their kinds; none: the engine's own
    std::vector<CheckSpec> checks;                             // in the order of the file
    std::vector<GoldenSpec> goldens;

    const collision::ShapeKinds& knownShapes() const;
    bool isFigure(const ColliderSpec& collider) const;  // an animation moves its mesh
};

// Whether any body of the scene touches others or itself.
bool bodiesTouch(const SceneSpec& spec);

// Makes all bodies that collide meet the figures, if there are any.
void meetFigures(SceneSpec& spec);

}  // namespace taut::world
