#include "taut/world/world.h"

namespace taut::world {
namespace {

// Bytes a point and a spring of a built island take, both precisions' worst, measured on a cloth and rounded up.
constexpr double bytesPerPoint = 600, bytesPerSpring = 120;

double copies(const ArraySpec& array) {
    return static_cast<double>(array.count.x) * array.count.y * array.count.z;
}

}  // namespace

Estimate estimate(const SceneSpec& spec) {
    Estimate sum;
    const auto add = [&](const BodySpec& body, double points, double springs) {
        sum.points += copies(body.array) * points;
        sum.springs += copies(body.array) * springs;
    };
    for (const ClothSpec& cloth : spec.cloths) {
        if (cloth.meshData) {
            const auto triangles = static_cast<double>(cloth.meshData->triangles.size());
            add(cloth, static_cast<double>(cloth.meshData->positions.size()), 3.0 * triangles);
            continue;
        }
        const double points = (cloth.cells.x + 1.0) * (cloth.cells.y + 1.0);
        add(cloth, points, 6.0 * points);
    }
    for (const RopeSpec& rope : spec.ropes) add(rope, rope.segments + 1.0, 2.0 * rope.segments);
    for (const BlockSpec& block : spec.blocks) {
        const double points = (block.cells.x + 1.0) * (block.cells.y + 1.0) * (block.cells.z + 1.0);
        add(block, points, 15.0 * points);  // nine springs and six tetrahedra
    }
    for (const NetSpec& net : spec.nets)
        add(net, static_cast<double>(net.points.size()), static_cast<double>(net.springs.size()));
    sum.bytes = bytesPerPoint * sum.points + bytesPerSpring * sum.springs;
    return sum;
}

}  // namespace taut::world
