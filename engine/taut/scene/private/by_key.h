// Values of a scene by the keys that a file has for them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/scene/private/splice.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::scene {

// Visits every number that stands under one of these keys, of `owner` ("wind.breeze"), or of every body and material
// where that is empty; also in tables inside. In the units of the file.
void eachNumber(world::SceneSpec& scene, const std::string& owner, std::span<const std::string_view> keys,
                const std::function<void(double&)>& visit);

// What of [solver], bodies, materials and forces differs under these keys, as `after` has it. Expects the same bodies,
// materials and forces in both. What has no value afterwards is left out.
std::vector<Change> differences(const world::SceneSpec& before, const world::SceneSpec& after,
                                std::span<const std::string_view> keys);

// As TOML: 2 as 2.0.
std::string numberText(double value);

}  // namespace taut::scene
