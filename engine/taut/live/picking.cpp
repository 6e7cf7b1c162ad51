#include "taut/live/picking.h"

#include <cmath>
#include <limits>

#include "taut/view/camera_axes.h"

namespace taut::live {
namespace {

constexpr double farAway = std::numeric_limits<double>::infinity();

struct Hit {
    double distance = farAway;  // [m] along the ray
    const view::Surface* surface = nullptr;
};

// Möller and Trumbore 1997; the distance along the ray, or infinite.
double distanceTo(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 e1 = b - a, e2 = c - a, p = glm::cross(ray.along, e2);
    const double det = glm::dot(e1, p);
    if (std::abs(det) < 1e-18) return farAway;
    const glm::dvec3 s = ray.from - a;
    const double u = glm::dot(s, p) / det;
    if (u < 0.0 || u > 1.0) return farAway;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(ray.along, q) / det;
    if (v < 0.0 || u + v > 1.0) return farAway;
    const double distance = glm::dot(e2, q) / det;
    return distance > 0.0 ? distance : farAway;
}

Hit firstHit(const Ray& ray, std::span<const view::Surface> surfaces) {
    Hit first;
    for (const view::Surface& surface : surfaces) {
        std::vector<glm::dvec3> corners;
        corners.reserve(surface.geometry->positions.size());
        for (const glm::vec3& p : surface.geometry->positions)
            corners.emplace_back(glm::vec3(surface.transform * glm::vec4(p, 1.0F)));
        const std::vector<std::uint32_t>& triangles = surface.topology->triangles;
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            const double distance =
                distanceTo(ray, corners[triangles[i]], corners[triangles[i + 1]], corners[triangles[i + 2]]);
            if (distance < first.distance) first = {distance, &surface};
        }
    }
    return first;
}

// The point of a body that is nearest to a place.
PickedPoint nearestTo(const BodyPoints& body, const glm::dvec3& place) {
    PickedPoint picked{body.name, 0, {}};
    double least = farAway;
    for (std::size_t i = 0; i < body.positions.size(); ++i) {
        const glm::dvec3 offset = body.positions[i] - place;
        const double square = glm::dot(offset, offset);
        if (!(square < least)) continue;
        least = square;
        picked.point = body.points[i];
        picked.position = body.positions[i];
    }
    return picked;
}

}  // namespace

Ray rayThrough(const view::Camera& camera, glm::dvec2 place, double aspect) {
    const view::CameraAxes axes = view::axesOf(camera);
    const double half = std::tan(0.5 * static_cast<double>(verticalField(camera, static_cast<float>(aspect))));
    const glm::dvec2 offset = half * glm::dvec2((2.0 * place.x - 1.0) * aspect, 1.0 - 2.0 * place.y);
    return {glm::dvec3(camera.eye), glm::normalize(glm::dvec3(axes.forward) + offset.x * glm::dvec3(axes.right) +
                                                   offset.y * glm::dvec3(axes.up))};
}

std::optional<glm::dvec2> seenAt(const view::Camera& camera, glm::dvec3 place, double aspect) {
    const view::CameraAxes axes = view::axesOf(camera);
    const glm::dvec3 offset = place - glm::dvec3(camera.eye);
    const double ahead = glm::dot(offset, glm::dvec3(axes.forward));
    if (!(ahead > 0.0)) return std::nullopt;
    const double half = ahead * std::tan(0.5 * static_cast<double>(verticalField(camera, static_cast<float>(aspect))));
    return glm::dvec2(0.5 + 0.5 * glm::dot(offset, glm::dvec3(axes.right)) / (half * aspect),
                      0.5 - 0.5 * glm::dot(offset, glm::dvec3(axes.up)) / half);
}

glm::dvec3 onPicturePlane(const Ray& ray, const view::Camera& camera, glm::dvec3 point) {
    const glm::dvec3 forward(view::axesOf(camera).forward);
    const double ahead = glm::dot(ray.along, forward), depth = glm::dot(point - ray.from, forward);
    if (!(ahead > 1e-6) || !(depth > 0.0)) return point;
    return ray.from + ray.along * (depth / ahead);
}

std::string nameOf(const PickedPoint& picked) {
    return picked.body + "@#" + std::to_string(picked.point);
}

std::optional<PickedPoint> pick(const Ray& ray, std::span<const view::Surface> surfaces,
                                std::span<const BodyPoints> bodies, double reach) {
    const Hit hit = firstHit(ray, surfaces);
    if (hit.surface != nullptr)
        for (const BodyPoints& body : bodies)
            if (body.name == hit.surface->name && !body.positions.empty())
                return nearestTo(body, ray.from + ray.along * hit.distance);

    // Beside everything that is drawn, or before a collider: any point near enough to the ray and not behind it.
    std::optional<PickedPoint> best;
    double least = reach;
    for (const BodyPoints& body : bodies)
        for (std::size_t i = 0; i < body.positions.size(); ++i) {
            const glm::dvec3 offset = body.positions[i] - ray.from;
            const double depth = glm::dot(offset, ray.along);
            if (!(depth > 0.0) || depth > hit.distance) continue;
            const double off = glm::length(offset - depth * ray.along) / depth;
            if (!(off < least)) continue;
            least = off;
            best = PickedPoint{body.name, body.points[i], body.positions[i]};
        }
    return best;
}

}  // namespace taut::live
