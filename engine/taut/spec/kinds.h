// The tables of kinds from which a scene can be made, as one value.
//
// To add a kind of your own: Kinds kinds = builtIn(); kinds.bodies.add(bodyKind<Mine>()); scene::loadSceneText(text,
// name, {.kinds = std::make_shared<const Kinds>(kinds)}).
#pragma once

#include <utility>

#include "taut/collision/shape_table.h"
#include "taut/core/table.h"
#include "taut/ode/method_table.h"
#include "taut/spec/action_spec.h"
#include "taut/spec/body_spec.h"
#include "taut/spec/common_rows.h"
#include "taut/spec/force_spec.h"
#include "taut/spec/joint_spec.h"
#include "taut/spec/specs.h"

namespace taut::world {

// Kinds of one sort, in the order of the manual.
template <class Base>
class KindTable : public core::Table<Kind<Base>> {
  public:
    // Expects a name that no other kind has.
    void add(Kind<Base> kind) {
        kind.section.name = kind.name;
        kind.section.layout = fields::Layout::named;
        core::Table<Kind<Base>>::add(std::move(kind));
    }
};

struct Kinds {
    KindTable<BodySpec> bodies;
    KindTable<JointSpec> joints;  // the first is the default kind
    KindTable<ForceSpec> forces;
    KindTable<ActionSpec> actions;
    ode::Methods methods;
    collision::ShapeKinds shapes;
};

// The kinds of the engine.
Kinds builtIn();
const KindTable<ActionSpec>& builtInActions();

}  // namespace taut::world
