// Reads actions for a running world, in the form that the timeline of its scene has.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/fields/field.h"
#include "taut/fields/node.h"
#include "taut/spec/actions.h"
#include "taut/spec/kinds.h"

namespace taut::scene {

// A number or a vector of the scene that ramps may change.
struct Rampable {
    std::string key;            // "wind.breeze.velocity"
    std::string unit;           // of the file
    fields::Range range;        // of each number
    std::vector<double> value;  // now, in this unit
};

class ActionReader {
  public:
    // root: of the document from which the scene was read.
    ActionReader(fields::Node root, world::Kinds kinds) : root_(std::move(root)), kinds_(std::move(kinds)) {}

    // Reads an action for now, t [s], as TOML without its moment:
    // `{ do = "push", target = "cloth.flag", impulse_Ns = [1, 0, 0] }`. Throws core::Error(badContent),
    // "LABEL: error: …", for all faults of the action itself. Missing hands, bodies and colliders are reported when it
    // is performed.
    std::unique_ptr<world::ActionSpec> read(const std::string& table, double t, const std::string& label,
                                            const world::SceneSpec& spec) const;

    // Data of an applied ramp for World::restore(). Throws core::Error(badContent) for a key that may not change.
    world::RampAction ramp(const std::string& key, const world::SceneSpec& spec) const;

    // All that ramps may change in the scene, in the order of the manual.
    std::vector<Rampable> rampable(const world::SceneSpec& spec) const;

  private:
    fields::Node root_;
    world::Kinds kinds_;
};

}  // namespace taut::scene
