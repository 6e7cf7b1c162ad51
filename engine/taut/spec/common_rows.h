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

// Of colliders and solids.
inline constexpr fields::Range lengthOfTorque{0.0, 1e3};  // [m]
inline constexpr const char* rollingHelp =
    "Largest torque against rolling over the force along the normal; a contact has the sum of its sides.";
inline constexpr const char* spinHelp =
    "Largest torque against spinning about the normal over the force along it; a contact has the sum of its sides.";

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
                "Strain beyond which springs keep a permanent deformation; default never.");
    list.number("break_strain", &Spec::plasticity, &PlasticitySpec::breakStrain, "", strainRange,
                "Strain at which a stretched spring tears; default never. At the tip of a tear it holds for cells of "
                "break_cell_m.")
        .number("break_cell_m", &Spec::plasticity, &PlasticitySpec::breakCell, "m", lengthRange,
                "Side of the cells for which break_strain holds at the tip of a tear. The limit grows with the square "
                "root of smaller cells, so that a tear needs the same load.")
        .number("strain_limit", &Spec::plasticity, &PlasticitySpec::strainLimit, "", strainRange,
                "Largest strain of stretched springs, except bending springs: they are stopped there, and the energy "
                "of the stopped motion is dissipated. Default unlimited.");
    return list;
}

// Fields of bodies with a stiffness of their own.
template <class Spec>
fields::FieldList<Spec> withLosses(fields::FieldList<Spec> list) {
    list.number("damping_time_s", &Spec::dampingTime, "s", dampingTimeRange,
                "Damping constant of a spring over its stiffness.")
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
               "Pinned points: a group, \"#12\", \"(u,v)\", \"(u,v,r)\", \"50%\".")
        .texts("clamp", &Spec::clamp, fields::Role::selector,
               "Points that are held in position and direction, as in a jaw. `hold` alone is a hinge.")
        .text("hold_on", &Spec::holdOn, fields::Role::collider,
              "Collider that carries the points of `hold` and `clamp`, e.g. \"collider.pole\": they follow its motion. "
              "Without it they do not move.")
        .vector("velocity", &Spec::velocity, "m/s", speedRange,
                "Initial velocity. Points faster than 3000 m/s count as diverged.")
        .vector("spin_rad_per_s", &Spec::spin, "rad/s", placeRange,
                "Initial angular velocity about the centre of mass.")
        .number("jitter_m", &Spec::jitter, "m", Range{0.0, 1.0},
                "Random initial offset of free points, to break symmetry.")
        .whole("seed", &Spec::seed, "", Range{0.0, 1e12}, "Seed of the offsets.")
        .number("friction", &Spec::friction, "", Range{0.0, 100.0},
                "Factor on the friction of colliders and other bodies.")
        .number("restitution", &Spec::restitution, "", Range{0.0, 1.0},
                "Factor on the restitution of colliders and other bodies.")
        .number("thickness", &Spec::thickness, "m", Range{0.0, 10.0},
                "Distance from colliders; bodies with `touch` keep the sum of theirs. Default of a rope or net: its "
                "radius.")
        .flagOr("collide", &Spec::collide, "faces", &Spec::meetsFaces,
                "Whether it collides with colliders: with its points, or with \"faces\" with its triangles and edges "
                "too, as always if `touch` is not \"nothing\". Points that start inside a collider leave at 1 m/s.")
        .choice("touch", &Spec::touch, {"nothing", "others", "all"},
                "Bodies it collides with: nothing, others with `touch`, or all, itself included.")
        .table("finish", &Spec::finish, finishSection(), "Appearance.")
        .table("solver", &Spec::solver, overrideSection(), "Solver settings of this body.")
        .table("array", &Spec::array, arraySection(), "Copies, named NAME.0, NAME.1 and so on.");
    return list.take();
}

// A kind of body: its own rows, then the common rows of bodies.
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
                "End of its ties on the first side that is a whole solid or collider.")
        .choice("place_in", &JointSpec::placeIn, {"side", "world"},
                "Axes of `place` and `axis`: the own ones of that side, or those of the scene as it starts.")
        .text("name", &JointSpec::name, fields::Role::none,
              "Name for the action release; it releases all joints of the name.")
        .number("break_N", &JointSpec::breakForce, "N", fields::positive,
                "Mean force of a tie over a tick above which the tie breaks; default never.")
        .flag("touch", &JointSpec::touch,
              "Whether the solids, or the solid and the collider, that it joins collide with each other.")
        .number("radius", &JointSpec::look, &JointLook::radius, "m", lengthRange, "Radius of the drawn cord or wire.")
        .whole("turns", &JointSpec::look, &JointLook::turns, "", fields::Range{0.0, 1000.0},
               "Number of turns of the drawn coil; 0: a straight cord.")
        .number("coil_radius", &JointSpec::look, &JointLook::coil, "m", lengthRange, "Radius of the drawn coil.")
        .tableOr("finish", &JointSpec::look, &JointLook::finish, finishSection(),
                 "Appearance; without it the joint is not drawn.")
        .take();
}

// Reports faults in the fields that every joint has.
void checkJoint(const fields::CheckInput& input, const JointSpec& joint);

// A kind of joint, from the rows of its own fields. The rows of the two sides come before them. A field may be `only`
// for joints between bodies, by the title ("a weld"), for joints with colliders ("a weld to a collider"), or for both.
// A key that another kind also has should mean the same. Expects no tables inside.
template <class Own>
Kind<JointSpec> jointKind(std::string help, fields::FieldList<Own> own = {}) {
    Kind<JointSpec> kind{std::string(Own::kindName), {}, [] { return std::make_unique<Own>(); }};
    kind.section.help = std::move(help);
    kind.section.fields =
        fields::FieldList<Own>()
            .targets("a", &JointSpec::a, &JointSide::targets, fields::Role::tieable,
                     "Points: KIND.NAME@SELECTOR, or a list of these.")
            .required()
            .targets("b", &JointSpec::b, &JointSide::targets, fields::Role::tieable,
                     "The other points, of the same or other bodies; or collider.NAME, on either side.")
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
                              .number("t", &ActionSpec::t, "s", momentRange, "Time, rounded to the nearest tick.")
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
