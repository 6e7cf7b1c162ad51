// What a scene can be made of: the tables of kinds, as one value.
//
// To add a kind of your own: Kinds kinds = builtIn(); kinds.bodies.add(bodyKind<Mine>()); scene::loadSceneText(text,
// name, {.kinds = kinds}).
#pragma once

#include <string_view>
#include <vector>

#include "taut/collision/shape_table.h"
#include "taut/ode/method_table.h"
#include "taut/world/body_spec.h"
#include "taut/world/common_rows.h"
#include "taut/world/force_spec.h"
#include "taut/world/specs.h"

namespace taut::world {

// Kinds of one sort, in the order of the manual.
template <class Base>
class KindTable {
  public:
    // Expects a name that no other has.
    void add(Kind<Base> kind) {
        TAUT_EXPECTS(!kind.name.empty() && find(kind.name) == nullptr);
        kind.section.name = kind.name;
        kind.section.layout = fields::Layout::named;
        rows_.push_back(std::move(kind));
    }
    const Kind<Base>* find(std::string_view name) const {
        for (const Kind<Base>& kind : rows_)
            if (kind.name == name) return &kind;
        return nullptr;
    }
    const std::vector<Kind<Base>>& all() const { return rows_; }

  private:
    std::vector<Kind<Base>> rows_;
};

struct Kinds {
    KindTable<BodySpec> bodies;
    KindTable<ForceSpec> forces;
    ode::Methods methods;
    collision::ShapeKinds shapes;
};

// Those of the engine.
Kinds builtIn();

}  // namespace taut::world
