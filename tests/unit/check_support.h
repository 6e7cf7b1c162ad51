// Common code of the tests of checks: small scenes from texts, and the verdicts of claims about them.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "taut/check/check.h"
#include "taut/check/private/evaluation.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::check {

inline world::SceneSpec sceneOf(const std::string& text) {
    return scene::loadSceneText("schema = 1\n[solver]\nprecision = \"double\"\n" + text, "s.toml", {}).spec;
}

inline void play(world::World& world, int ticks) {
    for (int i = 0; i < ticks; ++i) {
        const auto divergence = world.advance();
        ASSERT_FALSE(divergence) << divergence->message;
    }
}

inline double valueIn(const world::World& world, const std::string& expression) {
    return Check::parse(expression + " < 0").evaluate(world).value;
}

// Two balls of 1 and 3 kg, not tied, and a wall; without weight unless `world` says otherwise.
inline const std::string balls =
    "[net.balls]\ndrag_per_s = 0\ncollide = true\n"
    "points = [{ name = \"a\", position = [1, 2, 3], mass_kg = 1 }, { name = \"b\", position = [5, 2, 3], mass_kg = 3 "
    "},"
    " { name = \"wall\", position = [0, 0, 9], mass_kg = 1, hold = true }]\n"
    "springs = [{ a = \"a\", b = \"wall\", stiffness_N_per_m = 0 }, { a = \"b\", b = \"wall\", stiffness_N_per_m = 0 "
    "}]\n";

}  // namespace taut::check
