// The common data of bodies, and the interface to their kinds. The kinds are in bodies/.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/collision/geometry.h"
#include "taut/core/turn_friction.h"
#include "taut/mechanics/model.h"
#include "taut/spec/finish_spec.h"
#include "taut/spec/mesh_data.h"
#include "taut/spec/solver_spec.h"
#include "taut/spec/source.h"

namespace taut::world {

struct Body;
struct IslandPlan;
struct RigidPiece;
struct SceneSpec;
class BodyDrawing;

// When a material stops being elastic.
struct PlasticitySpec {
    std::optional<double> yieldStrain;  // |l - L|/L beyond which a spring's rest length yields; none: never
    std::optional<double> breakStrain;  // (l - L)/L beyond which a spring breaks; none: never
    std::optional<double> strainLimit;  // (l - L)/L that no spring but those of bending exceeds; none: any
    double breakCell = 0.02;            // [m] cell size for which breakStrain is stated; matters at the tip of a tear
};

// Bending rigidity of a sheet [N m]: across its warp, across its weft, and at 45° between them.
struct BendingSpec {
    std::optional<double> warp;  // none: no bending rigidity
    std::optional<double> weft;  // none: as the warp
    std::optional<double> bias;  // none: as of an isotropic sheet between both
};

// Friction of the threads of a sheet that bends.
struct BendingFrictionSpec {
    std::optional<double> hysteresis;  // 2HB [N], the height of the loop of moment per width over curvature; none: none
    std::optional<double> yield;       // [1/m] curvature from the turning point on at which threads slip
};

struct MaterialSpec {             // of cloth, per metre of material
    double density = 0.2;         // [kg/m²]
    double stretch = 900.0;       // k_s [N/m] along the warp
    std::optional<double> shear;  // k_d [N/m]; none: defaultShear()
    double bend = 1.0;            // k_b [N/m]
    double dampingTime = 1e-4;    // τ [s]
    double drag = 0.3;            // γ/m [1/s]
    mechanics::Lumping lumping = mechanics::Lumping::weighted;
    PlasticitySpec plasticity{};
    BendingSpec rigidity{};
    BendingFrictionSpec friction{};
    std::optional<double> weftStretch{};  // [N/m]; none: as the warp
    double air = 0.0;                     // [kg/m²] of air that goes along in a wind
    double flutter = 0.0;                 // the share of it that acts as on a stiff plate that turns [-]

    // Half the stretch, an isotropic sheet, if one number says the stretch; a twentieth of the softer one, as woven
    // cloth has it, if there are two.
    double defaultShear() const { return weftStretch ? 0.05 * std::min(stretch, *weftStretch) : 0.5 * stretch; }
};

// Which surfaces keep off each other: none, those of different bodies, or all, including parts of one body.
enum class Touch { nothing, others, all };

struct ArraySpec {  // copies of a body along three directions, named NAME.0, NAME.1, …
    ivec3 count{1, 1, 1};
    dvec3 stepX{0.0}, stepY{0.0}, stepZ{0.0};  // [m] from one copy to the next
};

// Data of a body before it is built. Counts are doubles, as they may be far beyond any integer.
struct BodyOutline {
    double points = 0, springs = 0, volumes = 0;
    std::vector<std::string> groups;  // names of point groups, as its builder gives them
    std::vector<std::string> places;  // names of places of a rigid body
    bool isGrid = false;              // accepts "(u,v)" and "(u,v,r)"
    bool isRound = false;             // has only the places in the ellipse
    bool isLine = false;              // accepts "50%"
    bool hasSurface = false;          // on which wind acts
};

struct BodySpec {
    std::string name;  // without the kind: "flag"
    Source source;
    std::vector<std::string> hold;   // selectors, see mechanics: a group, "(u,v)", "(u,v,r)", "50%", "#index"
    std::vector<std::string> clamp;  // further selectors; the direction at these points is held too
    std::string holdOn;              // "collider.pole" that carries the held points; empty: they stay in place
    dvec3 velocity{0.0};             // [m/s] at the start
    dvec3 spin{0.0};                 // [rad/s] at the start, about the centre of mass
    double jitter = 0.0;             // [m] random offset of free points at the start; breaks symmetry
    std::int64_t seed = 1;           // of the jitter
    double friction = 1.0;           // factor on the collider's friction
    double restitution = 1.0;        // factor on the restitution of colliders, and of bodies that touch
    core::TurnFriction turnFriction;
    double thickness = 0.005;  // [m] distance kept from colliders; two bodies that touch keep the sum of theirs
    bool collide = true;
    bool meetsFaces = false;    // its faces meet colliders even if it touches nothing
    bool meetsFigures = false;  // there are figures, which its faces meet
    Touch touch = Touch::nothing;
    FinishSpec finish;
    SolverOverride solver;
    ArraySpec array;

    BodySpec();
    BodySpec(const BodySpec&);
    BodySpec& operator=(const BodySpec&);
    virtual ~BodySpec();
    virtual std::string_view kind() const = 0;  // "cloth"
    virtual std::unique_ptr<BodySpec> copy() const = 0;
    std::string fullName() const { return std::string(kind()) + "." + name; }

    // At rest and free; for arrays, one copy. Throws core::Error(badContent) with file, line and column.
    virtual mechanics::Model build(const SceneSpec& scene) const = 0;
    // Whether its points keep their distances, so that a force on one acts on all.
    virtual bool isRigid() const { return false; }
    // Its own axes in the scene as it starts; those of the scene if it is not rigid.
    virtual collision::Frame axes() const { return {}; }
    // Of a rigid body, one for each part of its model.
    virtual std::vector<RigidPiece> pieces(const SceneSpec& scene) const;
    // Whether a surface that goes with its points meets others in their place.
    virtual bool hasCarriedSurface() const { return false; }
    // Whether it meets colliders in contact with bodies, not point by point as its island moves.
    bool meetsCollidersAsWhole() const { return isRigid() || hasCarriedSurface(); }
    virtual PlasticitySpec plasticityIn(const SceneSpec&) const { return {}; }
    // The material from which it takes numbers; empty: none.
    virtual std::string_view materialName() const { return {}; }

    // The drawing of a body of this spec: by default the triangles of its model, if there are any.
    virtual std::unique_ptr<BodyDrawing> drawing(const Body& body) const;
    // The number of its points, springs and cells. By default it builds the body and counts them.
    virtual BodyOutline outline(const SceneSpec& scene) const;
    // Whether not its points alone but its faces meet other bodies, or colliders.
    bool facesMeetColliders() const {
        return collide && (meetsFaces || meetsFigures || meetsCollidersAsWhole() || touch != Touch::nothing);
    }
    bool facesMeet() const { return touch != Touch::nothing || facesMeetColliders(); }

    // The mesh file from which it is made, or null.
    virtual const MeshSource* meshSource() const { return nullptr; }
    MeshSource* meshSource() { return const_cast<MeshSource*>(std::as_const(*this).meshSource()); }
    // Itself and its parts: each has a mesh file and a look.
    virtual std::vector<const BodySpec*> shapes() const { return {this}; }
    std::vector<BodySpec*> shapes() {
        std::vector<BodySpec*> all;
        for (const BodySpec* shape : std::as_const(*this).shapes()) all.push_back(const_cast<BodySpec*>(shape));
        return all;
    }
};

}  // namespace taut::world
