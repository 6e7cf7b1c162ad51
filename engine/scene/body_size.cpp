#include "taut/scene/body_size.h"

#include <unistd.h>

namespace taut::scene {

double BodySize::bytes() const {
    // Both precisions' worst, measured on a cloth and rounded up; a tetrahedron is as large as a spring.
    return 600.0 * points + 120.0 * (springs + volumes);
}

BodySize sizeOf(const world::BodySpec& body, const world::SceneSpec& scene) {
    const world::BodyOutline one = body.outline(scene);
    const glm::dvec3 count(body.array.count);
    const double copies = count.x * count.y * count.z;
    return {copies * one.points, copies * one.springs, copies * one.volumes};
}

BodySize sizeOf(const world::SceneSpec& scene) {
    BodySize sum;
    for (const world::BodySpec& body : scene.bodies) {
        const BodySize size = sizeOf(body, scene);
        sum.points += size.points;
        sum.springs += size.springs;
        sum.volumes += size.volumes;
    }
    return sum;
}

double memoryLimit() {
    const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
    const double pageSize = static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return 0.5 * pages * pageSize;
}

}  // namespace taut::scene
