#include "taut/advice/bending_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "taut/bodies/cloth.h"
#include "taut/core/private/contains.h"
#include "taut/mechanics/bending.h"
#include "taut/spec/spec.h"

namespace taut::world {
namespace {

constexpr double factor = 0.45;

// Along one direction of the cloth.
struct Along {
    double size, cell, bendingLength;  // [m]
    int cellsFor(double error) const { return static_cast<int>(std::ceil(size / cellFor(error, bendingLength))); }
};

}  // namespace

double bendingLength(double rigidity, double density, double gravity) {
    return std::cbrt(rigidity / (density * gravity));
}

double droopError(double cell, double bendingLength) {
    return factor * cell * cell / (bendingLength * bendingLength);
}

double cellFor(double droopError, double bendingLength) {
    return bendingLength * std::sqrt(droopError / factor);
}

std::vector<std::string> coarseCells(const SceneSpec& scene) {
    constexpr double most = 0.1;
    std::vector<std::string> notes, reported;  // reported: materials, each once
    const double gravity = std::sqrt(glm::dot(scene.world.gravity, scene.world.gravity));
    if (!(gravity > 0)) return notes;
    for (const ClothSpec& cloth : scene.bodies.of<ClothSpec>()) {
        const auto material = scene.materials.find(cloth.material);
        if (cloth.meshData || material == scene.materials.end() || !material->second.rigidity.warp) continue;
        const MaterialSpec& m = material->second;
        const auto length = [&](double rigidity) { return bendingLength(rigidity, m.density, gravity); };
        const auto rigidity = mechanics::orthotropicRigidity(
            *m.rigidity.warp, m.rigidity.weft.value_or(*m.rigidity.warp), m.rigidity.bias);
        if (!rigidity) continue;
        const auto lengthAt = [&](double angle) { return length(mechanics::rigidityAt(*rigidity, angle)); };
        const Along u{cloth.size.x, cloth.size.x / cloth.cells.x, lengthAt(cloth.grain)};
        const Along v{cloth.size.y, cloth.size.y / cloth.cells.y, lengthAt(0.5 * std::numbers::pi - cloth.grain)};
        const double error = std::max(droopError(u.cell, u.bendingLength), droopError(v.cell, v.bendingLength));
        const bool isReported = core::contains(reported, cloth.material);
        if (!(error > most) || isReported) continue;
        reported.push_back(cloth.material);
        notes.push_back(
            fmt::format("the cells of cloth.{} are coarse for {}, whose bending length is {:.2g} by {:.2g} mm: {}; "
                        "cells = [{}, {}] "
                        "would do for 10 %, [{}, {}] for 1 %",
                        cloth.name, cloth.material, 1e3 * u.bendingLength, 1e3 * v.bendingLength,
                        error < 1 ? fmt::format("how it droops is {:.0f} % off", 100 * error)
                                  : "its folds are as wide as cells allow",
                        u.cellsFor(0.1), v.cellsFor(0.1), u.cellsFor(0.01), v.cellsFor(0.01)));
    }
    return notes;
}

}  // namespace taut::world
