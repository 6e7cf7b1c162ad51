#include "taut/scene/private/body_size.h"

#include <unistd.h>

#include <algorithm>

#include "taut/spec/spec.h"

namespace taut::scene {

double BodySize::bytes() const {
    // The larger of the two precisions, measured on a cloth and rounded up; a tetrahedron takes as much as a spring.
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

namespace {

constexpr double bytesOfTriangle = 500.0, bytesOfKey = 200.0, bytesOfAction = 2000.0;
constexpr double bytesOfCollider = 4e3, bytesOfDrawnCollider = 9e4;
constexpr double bytesOfShadowTexel = 4.5, bytesOfPixel = 15.0, bytesOfSample = 12.0;  // for further samples
constexpr double bytesOfMean = 32.0;  // for a pixel of a picture that is drawn several times

double bytesOf(const world::ColliderSpec& collider) {
    double bytes = (collider.visible ? bytesOfDrawnCollider : bytesOfCollider) +
                   bytesOfKey * static_cast<double>(collider.keys.size());
    if (collider.meshData) bytes += bytesOfTriangle * static_cast<double>(collider.meshData->triangles.size());
    for (const world::ColliderSpec& part : collider.parts) bytes += bytesOf(part);
    return bytes;
}

}  // namespace

SceneSize wholeSizeOf(const world::SceneSpec& scene) {
    SceneSize size;
    size.bodies = sizeOf(scene).bytes();
    for (const world::ColliderSpec& collider : scene.colliders) size.colliders += bytesOf(collider);
    const world::PictureSpec& picture = scene.picture;
    size.pictures = static_cast<double>(picture.size.x) * picture.size.y *
                        (bytesOfPixel + bytesOfSample * (std::min(picture.samples, 4) - 1) +
                         (picture.samples > 4 ? bytesOfMean : 0.0)) +
                    bytesOfShadowTexel * picture.shadowSize * picture.shadowSize;
    size.timeline = bytesOfAction * static_cast<double>(scene.actions.size() + scene.checks.size());
    return size;
}

double memoryLimit() {
    const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
    const double pageSize = static_cast<double>(sysconf(_SC_PAGE_SIZE));
    return 0.5 * pages * pageSize;
}

}  // namespace taut::scene
