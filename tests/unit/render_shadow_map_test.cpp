// The depth of lit surfaces: geometry without GL.
#include "taut/render/private/shadow_map.h"

#include <gtest/gtest.h>

#include <random>

#include "taut/core/private/instruction_set.h"

namespace taut::render {
namespace {

constexpr int edge = 128;

std::vector<std::uint16_t> drawn(const std::vector<MapTriangle>& triangles) {
    std::vector<std::uint16_t> map(static_cast<std::size_t>(edge) * edge, 65535);
    depthKernels().drawTriangles(triangles.data(), static_cast<int>(triangles.size()), edge, 0, edge - 1, map.data());
    return map;
}

// A plane, cut into triangles around a point: each texel has the depth of its middle, to the nearest step, and none is
// left out.
TEST(ShadowMap, APlaneOfTrianglesHasItsDepthInEachTexel) {
    const auto depthAt = [](float x, float y) { return 0.1F + 0.004F * x + 0.002F * y; };
    std::mt19937 random(5);
    std::uniform_real_distribution<float> along(1.0F, 127.0F);
    for (int trial = 0; trial < 20; ++trial) {
        const glm::vec2 middle(along(random), along(random));
        const std::vector<glm::vec2> outline{{-9.0F, -9.0F},   {along(random), -9.0F},  {150.0F, -30.0F},
                                             {140.0F, 141.0F}, {along(random), 135.0F}, {-20.0F, 140.0F}};
        std::vector<MapTriangle> triangles;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const glm::vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
            triangles.push_back({{middle.x, a.x, b.x},
                                 {middle.y, a.y, b.y},
                                 {depthAt(middle.x, middle.y), depthAt(a.x, a.y), depthAt(b.x, b.y)}});
        }
        const std::vector<std::uint16_t> map = drawn(triangles);
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x) {
                const float expected = depthAt(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
                // Half a step of rounding, and as much of single precision.
                EXPECT_NEAR(static_cast<float>(map[y * edge + x]), 65535.0F * expected, 1.0F);
            }
        }
    }
}

TEST(ShadowMap, EveryInstructionSetGivesTheSameBits) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> along(-20.0F, 150.0F), aside(-9.0F, 9.0F), depth(0.0F, 1.0F);
    std::vector<MapTriangle> triangles;
    for (int i = 0; i < 300; ++i) {
        const float x = along(random), y = along(random), scale = i % 10 == 0 ? 10.0F : 1.0F;
        triangles.push_back({{x, x + scale * aside(random), x + scale * aside(random)},
                             {y, y + scale * aside(random), y + scale * aside(random)},
                             {depth(random), depth(random), depth(random)}});
    }
    const core::InstructionSet before = core::instructionSet();
    core::useInstructionSet(core::InstructionSet::sse2);
    const std::vector<std::uint16_t> first = drawn(triangles);
    for (const auto set : {core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        EXPECT_EQ(drawn(triangles), first);
    }
    core::useInstructionSet(before);
}

}  // namespace
}  // namespace taut::render
