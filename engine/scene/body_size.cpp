#include "taut/scene/body_size.h"

#include <unistd.h>

#include "taut/world/each_body.h"

namespace taut::scene {

namespace {

BodySize sizeOfCopies(const world::BodySpec& body, double points, double springs, double cells) {
    const glm::dvec3 count(body.array.count);
    const double copies = count.x * count.y * count.z;
    return {copies * points, copies * springs, copies * cells, points};
}

}  // namespace

double BodySize::bytes() const {
    // Both precisions' worst, measured on a cloth and rounded up; a cell of a block has six tetrahedra, each as large
    // as a spring.
    return 600.0 * points + 120.0 * (springs + 6.0 * cells);
}

BodySize sizeOf(const world::ClothSpec& cloth) {
    if (cloth.meshData) {
        const auto points = static_cast<double>(cloth.meshData->positions.size());
        const auto triangles = static_cast<double>(cloth.meshData->triangles.size());
        return sizeOfCopies(cloth, points, 3.0 * triangles, 0.0);
    }
    const double x = cloth.cells.x;
    const double y = cloth.cells.y;
    return sizeOfCopies(cloth, (x + 1) * (y + 1), 6.0 * x * y + x + y, 0.0);
}

BodySize sizeOf(const world::RopeSpec& rope) {
    const double segments = rope.segments;
    return sizeOfCopies(rope, segments + 1, rope.bend > 0.0 ? 2.0 * segments - 1 : segments, 0.0);
}

BodySize sizeOf(const world::BlockSpec& block) {
    const glm::dvec3 n(block.cells);
    const double cells = n.x * n.y * n.z;
    // Three edges and six face diagonals a cell.
    return sizeOfCopies(block, (n.x + 1) * (n.y + 1) * (n.z + 1), 9.0 * cells, cells);
}

BodySize sizeOf(const world::NetSpec& net) {
    return sizeOfCopies(net, static_cast<double>(net.points.size()), static_cast<double>(net.springs.size()), 0.0);
}

BodySize sizeOf(const world::SceneSpec& scene) {
    BodySize sum;
    forEachBody(scene, [&](const char*, const auto& body) {
        const BodySize size = sizeOf(body);
        sum.points += size.points;
        sum.springs += size.springs;
        sum.cells += size.cells;
    });
    return sum;
}

double memoryLimit() {
    const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
    const double pageSize = static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return 0.5 * pages * pageSize;
}

}  // namespace taut::scene
