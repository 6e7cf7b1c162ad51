// Values of a scene by their keys in the file.
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

// Visits every number under one of these keys, in tables inside too: of `owner` ("wind.breeze"), or of every body and
// material if `owner` is empty. In the units of the file.
void eachNumber(world::SceneSpec& scene, const std::string& owner, std::span<const std::string_view> keys,
                const std::function<void(double&)>& visit);

// The values under these keys in [solver], bodies, materials and forces that differ, as in `after`. Expects the same
// bodies, materials and forces in both. Leaves out keys without a value in `after`.
std::vector<Change> differences(const world::SceneSpec& before, const world::SceneSpec& after,
                                std::span<const std::string_view> keys);

// A number as TOML writes it: 2 as 2.0.
std::string numberText(double value);

}  // namespace taut::scene
