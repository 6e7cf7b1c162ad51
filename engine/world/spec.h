// What a scene asks for, as plain data with defaults. The loader fills it, the world is built from it; it knows
// neither files nor pictures. SI units; colours are sRGB as an artist writes them, 0 … 1.
//
// The loader refuses what is out of range (scene::manual() has every range). Who fills a scene in code keeps to the same
// ranges and words, which the world does not check again; that targets and materials exist it does.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/world/action_spec.h"
#include "taut/world/source.h"

namespace taut::collision {
class ShapeKinds;
}
namespace taut::ode {
class Methods;
}

namespace taut::world {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

enum class Precision { single_, double_ };
enum class OnDivergence { stop, freeze };
enum class Align { left, centre, right };

struct SolverSpec {
    std::string integrator = "leapfrog";
    std::optional<double> dt;  // [s] largest step; none: found from the stability bound ("auto")
    double safety = 0.9;       // share of the stability limit that "auto" uses
    Precision precision = Precision::single_;
    int newtonSteps = 1;        // of implicit Euler: linear solves a step, at most
    double cgTolerance = 1e-5;  // of implicit Euler: residual over right-hand side at which a solve ends
    int cgIterations = 1000;    // of implicit Euler: at most, a solve
    OnDivergence onDivergence = OnDivergence::stop;
    double freezeStrain =
        1.0;  // |l - L|/L of a spring (but those of bending) at which freezing takes a body to diverge
    std::shared_ptr<const ode::Methods> methods;  // that integrators are names of; none: the engine's own
};

// A body may override these parts of [solver]; none: as the scene has it.
struct SolverOverride {
    std::optional<std::string> integrator;
    std::optional<double> dt;
    std::optional<double> safety;
    std::optional<int> newtonSteps;
    std::optional<double> cgTolerance;
    std::optional<int> cgIterations;
    bool operator==(const SolverOverride&) const = default;
};

struct WorldSpec {
    dvec3 gravity{0.0, -9.81, 0.0};  // [m/s²]
    double airDensity = 1.2;         // [kg/m³]
};

struct RunSpec {
    double fps = 60.0;     // pictures a second of scene time
    double seconds = 5.0;  // length
};

struct NeedSpec {                       // what "accurate enough" means for the scene
    std::optional<double> rmsPosition;  // [m]
    std::optional<double> rmsPercent;   // [% of the bounding box]
    std::optional<double> rmsPixels;    // [px at the output size]
    std::optional<double> horizon;      // [s]
    std::optional<double> budget;       // [ms a frame]
};

// What hands may do while the scene runs. A timeline's own grabs are allowed for without it.
struct HandSpec {
    bool anywhere = false;      // any point of any body may be grabbed: every step allows for it
    double strength = 200.0;    // [N/m] at most, of a hand
    double dampingRatio = 0.3;  // at most
};

// A claim about the state, e.g. "max_strain(cloth.*) < 0.1". With neither at nor from and upTo it must always hold.
struct CheckSpec {
    Source source;  // of the text's first character
    std::string that;
    std::optional<double> at;          // [s] at this moment
    std::optional<double> from, upTo;  // [s] all through this span, ends included
};

// Pictures to compare with recorded ones.
struct GoldenSpec {
    Source source;
    std::vector<int> frames;  // numbers, from 0
    bool restart = false;     // drawn from the state stored with the picture instead of the one just computed
    bool debug = false;       // with springs, points and contacts
    std::string camera;       // name; empty: that of [picture]
    ivec2 size{640, 360};     // [px]
};

// When a material stops being elastic.
struct PlasticitySpec {
    std::optional<double> yieldStrain;  // |l - L|/L beyond which a spring's rest length gives way; none: never
    std::optional<double> breakStrain;  // (l - L)/L beyond which a spring is gone; none: never
};

// How a thing looks; see view::Finish.
struct FinishSpec {
    dvec3 colour{0.75, 0.72, 0.68};
    std::optional<dvec3> backColour;  // none: a paler colour
    dvec3 accent{0.95, 0.93, 0.88};
    std::string pattern = "plain";  // plain checker stripes tartan image
    double repeat = 0.25;           // [m]
    double weave = 0.0;             // 0 … 1
    double thread = 0.012;          // [m]
    double roughness = 0.7;         // 0 … 1
    double sheen = 0.0;             // 0 … 1
    std::string texture;            // path, resolved by the loader
};

struct MaterialSpec {                  // of cloth, per metre of material
    double density = 0.2;              // [kg/m²]
    double stretch = 900.0;            // k_s [N/m]
    std::optional<double> shear;       // k_d [N/m]; none: stretch / 2, isotropic
    double bend = 1.0;                 // k_b [N/m]
    double dampingTime = 1e-4;         // τ [s]
    double drag = 0.3;                 // γ/m [1/s]
    std::string lumping = "weighted";  // weighted uniform
    PlasticitySpec plasticity{};
};

struct ArraySpec {  // copies of a body along three directions, named NAME.0, NAME.1, …
    ivec3 count{1, 1, 1};
    dvec3 stepX{0.0}, stepY{0.0}, stepZ{0.0};  // [m] from one copy to the next
};

// What every body has.
struct BodySpec {
    std::string name;  // without the kind: "flag"
    Source source;
    std::vector<std::string> hold;  // selectors, see mechanics: a group, "(u,v)", "50%", "#index"
    dvec3 velocity{0.0};            // [m/s] at the start
    dvec3 spin{0.0};                // [rad/s] at the start, about the centre of mass
    double jitter = 0.0;            // [m] random offset of free points at the start: breaks symmetry
    std::int64_t seed = 1;          // of the jitter
    double friction = 1.0;          // factor on the collider's friction
    double thickness = 0.005;       // [m] distance kept from colliders
    bool collide = true;
    FinishSpec finish;
    SolverOverride solver;
    ArraySpec array;
};

// What an OBJ file holds, before scale, rotation and position: vertices welded by position, each used by a triangle.
struct MeshData {
    std::vector<dvec3> positions;               // (vertices) in the file's unit
    std::vector<dvec2> uv;                      // (vertices) as in the file, or empty if a corner has none
    std::vector<std::array<int, 3>> triangles;  // (triangles) indices of vertices, in the file's orientation
};

struct ClothSpec : BodySpec {
    // A grid …
    dvec2 size{1.0, 1.0};  // [m]
    ivec2 cells{20, 20};
    dvec3 origin{0.0};            // top left corner [m]
    dvec3 across{1.0, 0.0, 0.0};  // direction from left to right
    dvec3 down{0.0, -1.0, 0.0};   // direction from top to bottom
    // … or an OBJ mesh (then the five fields above are not allowed).
    std::string mesh;                          // path, resolved by the loader; empty: a grid
    std::shared_ptr<const MeshData> meshData;  // what the file holds; null: a grid
    dvec3 position{0.0};                       // [m]
    dvec3 rotation{0.0};                       // [rad] about x, then y, then z
    double scale = 1.0;
    std::string material;  // name of a [material.NAME]
};

struct RopeSpec : BodySpec {
    dvec3 start{0.0}, end{1.0, 0.0, 0.0};  // ends = [[…], […]] in the file [m]
    int segments = 40;
    double length = 0.0;        // natural length [m]; 0: the distance of the ends
    double mass = 1.0;          // [kg]
    double stretch = 1e4;       // EA [N]
    double bend = 0.0;          // EA of the span-2 springs [N]
    double dampingTime = 1e-4;  // [s]
    double drag = 0.3;          // [1/s]
    double radius = 0.02;       // [m] drawn
    std::string lumping = "weighted";
    PlasticitySpec plasticity{};
};

struct BlockSpec : BodySpec {
    dvec3 size{0.5, 0.5, 0.5};  // [m]
    ivec3 cells{4, 4, 4};
    dvec3 position{0.0};          // centre [m]
    dvec3 rotation{0.0};          // [rad]
    double density = 300.0;       // [kg/m³]
    double young = 2e4;           // [Pa]
    double bulk = 2e4;            // [Pa]
    double dampingTime = 1e-3;    // [s]
    double drag = 0.1;            // [1/s]
    double workingStretch = 1.5;  // up to which the step must hold [-]
    std::string lumping = "weighted";
    PlasticitySpec plasticity{};
};

struct NetPointSpec {
    std::string name;
    dvec3 position{0.0};  // [m]
    double mass = 1.0;    // [kg]
    bool hold = false;
    Source source;
};
struct NetSpringSpec {
    std::string a, b;                   // names of two points
    double stiffness = 100.0;           // [N/m]
    std::optional<double> restLength;   // [m]; none: the distance
    std::optional<double> dampingTime;  // [s]; none: the net's
    Source source;
};
struct NetSpec : BodySpec {
    std::vector<NetPointSpec> points;
    std::vector<NetSpringSpec> springs;
    double dampingTime = 0.0;  // [s]
    double drag = 0.1;         // [1/s]
    double radius = 0.015;     // [m] of a drawn spring
    double ball = 0.06;        // [m] radius of a drawn point
    PlasticitySpec plasticity{};
};

// Targets are written KIND.NAME@SELECTOR, e.g. "cloth.flag@left"; NAME may have the wildcard *.
struct JointSpec {
    std::string a, b;
    std::string kind = "weld";  // weld spring
    double stiffness = 1e4;     // [N/m] of each spring
    double dampingTime = 1e-4;  // [s]
    double reach = 0.02;        // [m] a weld joins points at most this far apart
    Source source;
};

struct MassSpec {  // mass added to points
    std::string target;
    double mass = 1.0;  // [kg] shared evenly among the target's points
    Source source;
};

struct AnchorSpec {  // a spring of zero rest length from each target point to a place, or to a moving place
    std::string name;
    std::string target;
    dvec3 at{0.0};             // [m]
    double stiffness = 100.0;  // [N/m] of each point
    double damping = 0.0;      // [kg/s] of each point
    Source source;
};

struct PoseKey {
    double t = 0.0;            // [s]
    dvec3 position{0.0};       // [m]
    dvec3 rotation{0.0};       // [rad]
    Ease ease = Ease::smooth;  // from the key before to this one
};

struct ColliderSpec {
    std::string name;
    Source source;
    std::string shape = "sphere";  // a name from the table of shapes (collision/shape_table.h), or compound
    dvec3 position{0.0};           // [m]
    dvec3 rotation{0.0};           // [rad]
    dvec3 normal{0.0, 1.0, 0.0};   // plane
    dvec3 size{1.0};               // box: whole edges [m]
    double radius = 0.5;           // [m]
    double height = 1.0;           // [m] cylinder, cone: whole; capsule: between the centres of its half spheres
    std::map<std::string, double, std::less<>> sizes;  // what the shape adds to these, by its key
    std::string mesh;              // hull, mesh: path of an OBJ file, resolved by the loader
    std::shared_ptr<const MeshData> meshData;  // what the file holds; null: no mesh
    double scale = 1.0;
    std::vector<ColliderSpec> parts;  // compound
    double friction = 0.3;     // Coulomb's μ [-]
    double restitution = 0.0;  // 0 … 1: speed after a bounce / speed before [-]
    std::vector<PoseKey> keys;  // keyframes; then position and rotation are not used
    bool visible = true;
    double edge = 0.01;  // [m] rounding of a drawn box's edges
    FinishSpec finish;
};

struct WindSpec {
    std::string name;
    Source source;
    dvec3 velocity{0.0};       // [m/s]
    double gustAmplitude = 0;  // [m/s]
    double gustPeriod = 1.5;   // [s]
    double gustLength = 2.0;   // [m] size of an eddy
    std::int64_t gustSeed = 1;
    double drag = 1.0;            // drag coefficient of a triangle across the flow [-]
    double lift = 0.6;            // lift coefficient [-]
    std::vector<std::string> on;  // bodies it acts on, e.g. "cloth.*"; empty: every cloth
};

struct CameraKey {
    double t = 0.0;               // [s]
    dvec3 eye{0.0}, target{0.0};  // [m]
    std::optional<double> fieldOfView;  // [rad]
    Ease ease = Ease::smooth;
};
struct CameraSpec {
    std::string name;
    Source source;
    dvec3 eye{0.0, 1.5, 5.0}, target{0.0, 1.0, 0.0};  // [m]
    double fieldOfView = 0.66;                        // [rad] vertical
    std::vector<CameraKey> keys;
    std::optional<double> orbitPeriod;  // [s] one turn about the vertical through the target
};

struct LightSpec {
    dvec3 direction{-0.5, -1.0, -0.4};  // the way the light travels
    dvec3 colour{1.0, 0.96, 0.9};
    double intensity = 3.0;  // factor on colour
    double softness = 0.03;  // [rad]
    dvec3 sky{0.62, 0.70, 0.82};
    dvec3 ground{0.50, 0.48, 0.45};
    double ambient = 0.6;  // factor on sky and ground
};

struct BackgroundSpec {
    dvec3 top{0.25, 0.32, 0.44};
    dvec3 horizon{0.60, 0.64, 0.70};
    double fadeStart = 8.0;  // [m]
    double fadeEnd = 30.0;   // [m]
};

// A line of text in the picture. A body's name hangs above it unless a place is given; once the body is frozen, a
// second line says so.
struct LabelSpec {
    std::string name;
    Source source;
    std::optional<std::string> text;  // none: the method of the body
    std::optional<dvec3> at;          // [m] a place of the world
    std::optional<dvec2> screen;      // a place of the picture from its top left, as shares of width and height
    std::string of;                   // bodies, e.g. "cloth.*"; empty: none
    double size = 0.035;              // [picture heights]
    dvec3 colour{1.0, 1.0, 1.0};
    Align align = Align::centre;
    double plate = 0.0;  // darkness behind the text, 0 … 1
};

struct PictureSpec {
    ivec2 size{1280, 720};  // [px]
    std::string camera;     // name; empty: the first by name
    int samples = 4;        // multisampling
    int shadowSize = 2048;  // [px] edge of the shadow map
};

struct SceneSpec {
    std::string file;
    std::string base;  // the file that it builds on; empty: none
    std::string title;
    WorldSpec world;
    SolverSpec solver;
    RunSpec run;
    NeedSpec need;
    PictureSpec picture;
    LightSpec light;
    BackgroundSpec background;
    std::map<std::string, MaterialSpec> materials;
    // Sorted by name.
    std::vector<ClothSpec> cloths;
    std::vector<RopeSpec> ropes;
    std::vector<BlockSpec> blocks;
    std::vector<NetSpec> nets;
    std::vector<JointSpec> joints;  // in the order of the file
    std::vector<MassSpec> masses;   // in the order of the file
    std::vector<AnchorSpec> anchors;
    std::vector<ColliderSpec> colliders;
    std::shared_ptr<const collision::ShapeKinds> shapes;  // that colliders may have; none: the engine's own
    std::vector<WindSpec> winds;
    std::vector<CameraSpec> cameras;
    std::vector<LabelSpec> labels;
    HandSpec hand;
    std::vector<ActionSpec> actions;  // by time, those of one moment in the order of the file
    std::vector<CheckSpec> checks;    // in the order of the file
    std::vector<GoldenSpec> goldens;
};

}  // namespace taut::world
