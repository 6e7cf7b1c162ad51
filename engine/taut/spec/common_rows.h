// Rows of fields that several sections of a scene share, and functions that turn structs of bodies, joints, forces and
// actions into kinds.
#pragma once

#include <functional>

#include "taut/core/error.h"
#include "taut/fields/field_list.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/spec/action_spec.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/force_spec.h"
#include "taut/spec/joint_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Limits that many fields share.
inline constexpr fields::Range placeRange{-1e6, 1e6};                                      // [m]
inline constexpr fields::Range speedRange{-mechanics::speedLimit, mechanics::speedLimit};  // [m/s]
inline constexpr fields::Range lengthRange{1e-6, 1e6};                                     // [m]
inline constexpr fields::Range momentRange{0.0, 1e6};                                      // [s]
inline constexpr fields::Range countRange{1.0, 1e9};        // of cells; too large a sum is reported once all is read
inline constexpr fields::Range dampingTimeRange{0.0, 1e3};  // [s]
inline constexpr fields::Range dragRange{0.0, 1e6};         // [1/s]
inline constexpr fields::Range strainRange{1e-6, 1e3};      // |l - L|/L

fields::Section finishSection();
fields::Section overrideSection();  // of [solver], by a body
fields::Section arraySection();
std::vector<std::string> easeNames();
std::vector<std::string> lumpingNames();
std::vector<std::string> methodNames();  // of the engine
// If no thickness is given, a round thing gets its radius [m]. Warns of a thickness far below the radius.
void keepRadius(const fields::CheckInput& input, double radius, BodySpec& body);

// Fields of bodies and materials that may stop being elastic.
template <class Spec>
fields::FieldList<Spec> withPlasticity(fields::FieldList<Spec> list) {
    list.number("yield_strain", &Spec::plasticity, &PlasticitySpec::yieldStrain, "", strainRange,
                "Strain beyond which springs keep part of it for good; never if not given.");
    list.number(
            "break_strain", &Spec::plasticity, &PlasticitySpec::breakStrain, "", strainRange,
            "Strain of a stretched spring at which it tears; never if not given. At the tip of a tear it is meant for "
            "cells of break_cell_m.")
        .number("break_cell_m", &Spec::plasticity, &PlasticitySpec::breakCell, "m", lengthRange,
                "Side of the cells for which break_strain holds at the tip of a tear. With smaller ones it is larger "
                "there, as their square root, so that a tear takes the same load to run.")
        .number(
            "strain_limit", &Spec::plasticity, &PlasticitySpec::strainLimit, "", strainRange,
            "Strain that no stretched spring but those of bending exceeds: it is stopped there, and the energy with "
            "which it went on is lost. Any if not given.");
    return list;
}

// Fields of bodies with a stiffness of their own.
template <class Spec>
fields::FieldList<Spec> withLosses(fields::FieldList<Spec> list) {
    list.number("damping_time_s", &Spec::dampingTime, "s", dampingTimeRange,
                "Damping of a spring over its stiffness: inner friction.")
        .ramps(fields::Affects::springs);
    list.number("drag_per_s", &Spec::drag, "1/s", dragRange, "Rate at which still air slows a point.")
        .ramps(fields::Affects::springs);
    return list;
}

// Fields of every body.
template <class Spec>
std::vector<fields::Field> bodyRows() {
    using fields::Range;
    fields::FieldList<Spec> list;
    list.texts("hold", &Spec::hold, fields::Role::selector,
               "Points that never move: a group, \"#12\", \"(u,v)\", \"(u,v,r)\", \"50%\".")
        .texts("clamp", &Spec::clamp, fields::Role::selector,
               "Points that are held and whose direction is held too, as by a jaw: there what has a bending rigidity "
               "goes on straight. `hold` alone is a hinge.")
        .text(
            "hold_on", &Spec::holdOn, fields::Role::collider,
            "The collider that carries the points of `hold` and `clamp`, e.g. \"collider.pole\": they go and turn with "
            "it. Without it they stay where they are.")
        .vector("velocity", &Spec::velocity, "m/s", speedRange,
                "At the start. Whatever moves faster than 3000 m/s counts as diverged.")
        .vector("spin_rad_per_s", &Spec::spin, "rad/s", placeRange, "At the start, about the centre of mass.")
        .number("jitter_m", &Spec::jitter, "m", Range{0.0, 1.0},
                "Random offset of the free points at the start, to break symmetry.")
        .whole("seed", &Spec::seed, "", Range{0.0, 1e12}, "Seed of the offsets.")
        .number("friction", &Spec::friction, "", Range{0.0, 100.0}, "Factor on the collider's friction.")
        .number("restitution", &Spec::restitution, "", Range{0.0, 1.0},
                "Factor on the collider's restitution, and on that of bodies that touch.")
        .number(
            "thickness", &Spec::thickness, "m", Range{0.0, 10.0},
            "Distance kept from colliders; bodies that touch keep the sum of theirs. Of a rope or net its radius if "
            "not given.")
        .flagOr(
            "collide", &Spec::collide, "faces", &Spec::meetsFaces,
            "Whether colliders stop it: its points, and with \"faces\" its triangles and edges, which their corners "
            "and sharp edges do not go through; so too where `touch` is not \"nothing\". Points that start inside "
            "one come out at 1 m/s.")
        .choice("touch", &Spec::touch, {"nothing", "others", "all"},
                "What of other bodies stops it: nothing, those that touch others too, or all, its own parts as well.")
        .table("finish", &Spec::finish, finishSection(), "How it looks.")
        .table("solver", &Spec::solver, overrideSection(), "Its own way to be computed.")
        .table("array", &Spec::array, arraySection(), "Copies, called NAME.0, NAME.1 and so on.");
    return list.take();
}

// A kind of body: its own rows, then those that every body has.
template <class Own>
Kind<BodySpec> bodyKind() {
    Kind<BodySpec> kind = kindOf<Own, BodySpec>();
    for (fields::Field& row : bodyRows<Own>()) kind.section.fields.push_back(std::move(row));
    return kind;
}

template <class Own>
Kind<ForceSpec> forceKind() {
    return kindOf<Own, ForceSpec>();
}

// Fields of every joint besides its sides.
template <class Own>
std::vector<fields::Field> everyJointsRows() {
    return fields::FieldList<Own>()
        .vector("place", &JointSpec::place, "m", placeRange,
                "Where its ties end on a collider or a rigid body that is a side as a whole, solid.NAME: in the own "
                "axes of "
                "the first such side.")
        .text("name", &JointSpec::name, fields::Role::none,
              "By which an action releases it, and others of that name with it.")
        .number("break_N", &JointSpec::breakForce, "N", fields::positive,
                "Force through a tie, as the mean of a tick, above which that tie lets go; never if not given.")
        .number("radius", &JointSpec::look, &JointLook::radius, "m", lengthRange, "Of the cord or wire that is drawn.")
        .whole("turns", &JointSpec::look, &JointLook::turns, "", fields::Range{0.0, 1000.0},
               "Of the coil that is drawn; 0: a straight cord.")
        .number("coil_radius", &JointSpec::look, &JointLook::coil, "m", lengthRange, "Of the coil that is drawn.")
        .tableOr("finish", &JointSpec::look, &JointLook::finish, finishSection(),
                 "How it looks; not drawn if not given.")
        .take();
}

// Reports faults in the fields that every joint has.
void checkJoint(const fields::CheckInput& input, const JointSpec& joint);

// A kind of joint, from the rows of its own fields. The rows of both sides come before them. A field may be `only` for
// joints between bodies, by the title ("a weld"), for joints with colliders ("a weld to a collider"), or for both. A
// key that another kind also has should mean the same. Expects no tables inside.
template <class Own>
Kind<JointSpec> jointKind(std::string help, fields::FieldList<Own> own = {}) {
    Kind<JointSpec> kind{std::string(Own::kindName), {}, [] { return std::make_unique<Own>(); }};
    kind.section.help = std::move(help);
    kind.section.fields = fields::FieldList<Own>()
                              .targets("a", &JointSpec::a, &JointSide::targets, fields::Role::tieable,
                                       "Points: KIND.NAME@SELECTOR, or a list of such.")
                              .required()
                              .targets("b", &JointSpec::b, &JointSide::targets, fields::Role::tieable,
                                       "The others, of the same body or of others; or collider.NAME, on either side.")
                              .required()
                              .take();
    for (fields::Field& row : own.take()) {
        TAUT_EXPECTS(row.inside.empty());
        kind.section.fields.push_back(std::move(row));
    }
    for (fields::Field& row : everyJointsRows<Own>()) kind.section.fields.push_back(std::move(row));
    kind.section.check = [](const fields::CheckInput& input, void* joint) {
        checkJoint(input, *static_cast<const Own*>(joint));
    };
    return kind;
}

// A check of several fields of a kind: reports faults in an action that was read.
template <class Own>
using ActionCheck = std::function<void(const fields::CheckInput& input, const Own& action)>;

// A kind of action, from the rows of its own fields. Its moment comes before them. A key that another kind also has
// should mean the same. Expects no tables inside.
template <class Own>
Kind<ActionSpec> actionKind(fields::FieldList<Own> own, ActionCheck<Own> check = {}) {
    Kind<ActionSpec> kind{std::string(Own::kindName), {}, [] { return std::make_unique<Own>(); }};
    kind.section.fields = fields::FieldList<Own>()
                              .number("t", &ActionSpec::t, "s", momentRange, "Moment; the nearest tick is taken.")
                              .required()
                              .role(fields::Role::time)
                              .take();
    for (fields::Field& row : own.take()) {
        TAUT_EXPECTS(row.inside.empty());
        kind.section.fields.push_back(std::move(row));
    }
    if (check)
        kind.section.check = [check](const fields::CheckInput& input, void* action) {
            check(input, *static_cast<const Own*>(action));
        };
    return kind;
}

}  // namespace taut::world
