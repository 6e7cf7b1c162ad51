// Networks whose fastest motion is known in closed form.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/forces/anchor.h"
#include "taut/spec/spec.h"
#include "taut/study/threshold.h"

namespace taut::study {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// 2 √(k/m) cos(π/2(n+1)): n free masses between two walls, nothing but springs from each to the next.
double ropeFrequency(const world::RopeSpec& rope) {
    const auto holds = [&](const char* group) { return core::contains(rope.hold, group); };
    const bool isHeld = holds("ends") || (holds("start") && holds("end"));
    const double distance = glm::length(rope.end - rope.start);
    const bool isStraight = rope.through.empty() && (rope.length == 0.0 || rope.length <= distance);
    if (!isHeld || !isStraight || rope.bend != 0.0 || rope.rigidity || rope.segments < 2) return unknown;
    const double natural = rope.length == 0.0 ? distance : rope.length;
    const double k = rope.stretch * rope.segments / natural;
    const double m = rope.mass / (rope.lumping == mechanics::Lumping::uniform ? rope.segments + 1 : rope.segments);
    return 2 * std::sqrt(k / m) * std::cos(std::numbers::pi / (2 * rope.segments));
}

// The fastest plane wave of an endless square grid with structural springs k_s, diagonals k_d and span-2 springs k_b.
double gridFrequency(const world::ClothSpec& cloth, const world::MaterialSpec& material) {
    const double a = cloth.size.x / cloth.cells.x, b = cloth.size.y / cloth.cells.y;
    const bool isSquare = std::abs(a - b) < 1e-9 * a;
    if (!isSquare || cloth.isRound || cloth.meshData || cloth.cells.x < 4 || cloth.cells.y < 4) return unknown;
    if (material.lumping == mechanics::Lumping::uniform || material.rigidity.warp || material.weftStretch)
        return unknown;
    const double ks = material.stretch, kd = material.shear.value_or(ks / 2), kb = material.bend;
    const double sum = ks + kd, bends = kb + kd;
    double most = 4 * sum;
    if (kb > sum / 4) most = std::max(most, (4 * kb + sum) * (4 * kb + sum) / (4 * kb));
    if (bends > ks / 4) most = std::max(most, (4 * bends + ks) * (4 * bends + ks) / (4 * bends));
    return std::sqrt(most / (material.density * a * b));
}

}  // namespace

double closedFormFrequency(const world::SceneSpec& spec, const std::vector<std::string>& bodies, std::string& formula) {
    if (bodies.size() != 1 || !spec.forces.of<world::AnchorSpec>().empty() || !spec.masses.empty()) return unknown;
    for (const world::RopeSpec& rope : spec.bodies.of<world::RopeSpec>()) {
        if (rope.fullName() != bodies.front()) continue;
        formula = "2 √(k/m) cos(π/2(n+1))";
        return ropeFrequency(rope);
    }
    for (const world::ClothSpec& cloth : spec.bodies.of<world::ClothSpec>()) {
        if (cloth.fullName() != bodies.front()) continue;
        const auto material = spec.materials.find(cloth.material);
        formula = "the fastest plane wave of an endless grid";
        return gridFrequency(cloth, material == spec.materials.end() ? world::MaterialSpec{} : material->second);
    }
    return unknown;
}

bool isReferenceNetwork(const std::string& name) {
    return name == "rope" || name == "cloth";
}

world::SceneSpec referenceNetwork(const std::string& name) {
    world::SceneSpec scene;
    scene.file = name;
    scene.world.gravity = glm::dvec3(0.0);
    scene.run.seconds = 0.5;
    if (name == "rope") {  // a tenth longer than it wants to be: springs under compression would let it buckle
        world::RopeSpec rope;
        rope.name = "line";
        rope.start = {0.0, 0.0, 0.0};
        rope.end = {1.1, 0.0, 0.0};
        rope.length = 1.0;
        rope.segments = 20;
        rope.mass = 0.5;
        rope.stretch = 500.0;
        rope.dampingTime = rope.drag = 0.0;
        rope.hold = {"ends"};
        scene.title = "Rope of 20 segments between two walls, undamped";
        scene.bodies.add(rope);
        return scene;
    }
    TAUT_EXPECTS(name == "cloth");
    world::MaterialSpec& plain = scene.materials["plain"];
    plain.stretch = 600.0;
    plain.shear = 300.0;
    plain.bend = 2.0;
    plain.dampingTime = plain.drag = 0.0;
    world::ClothSpec cloth;
    cloth.name = "sheet";
    cloth.size = {1.0, 1.0};
    cloth.cells = {16, 16};
    cloth.material = "plain";
    cloth.hold = {"edges"};
    cloth.collide = false;
    scene.title = "Square cloth of 16 × 16 cells held all round, undamped";
    scene.bodies.add(cloth);
    return scene;
}

}  // namespace taut::study
