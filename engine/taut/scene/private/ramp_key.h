// The field that a ramp's key names: "wind.breeze.velocity" as a field of the scene that may change during the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "taut/scene/private/body_index.h"
#include "taut/scene/private/sections.h"
#include "taut/spec/actions.h"

namespace taut::scene {

struct RampKey {
    const Field* field = nullptr;                    // a row of `sections`
    std::shared_ptr<const world::RampField> access;  // values as in the file
};

// Nothing, with a fault, if the key names nothing, something that cannot change, or something without a value to start
// from. `root` is the document from which `scene` was read.
std::optional<RampKey> rampKey(const std::string& key, const Node& root, const std::vector<SceneSection>& sections,
                               world::SceneSpec& scene, TargetFault& fault);

// The keys of a document that ramps may change, also keys without a value to start from.
std::vector<std::string> rampableKeys(const std::vector<SceneSection>& sections, const Node& root);

// One line for each section that ramps may change, with its name and keys, for the manual and for messages.
std::vector<std::string> rampableLines(const std::vector<SceneSection>& sections);

}  // namespace taut::scene
