// Finds the point under the mouse: rays through a picture, and the point of a body for a hand. Independent of the mouse
// and the world.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/view/frame_view.h"

namespace taut::live {

struct Ray {
    glm::dvec3 from{0.0}, along{0.0, 0.0, -1.0};  // [m], unit
};

// The ray through a place of the picture, given as shares of width and height from the top left; `aspect` is width /
// height.
Ray rayThrough(const view::Camera& camera, glm::dvec2 place, double aspect);

// The place in the picture where a place [m] appears, in the same shares; none if it is behind the camera.
std::optional<glm::dvec2> seenAt(const view::Camera& camera, glm::dvec3 place, double aspect);

// Where the ray meets the plane through `point` parallel to the picture; `point` itself if it does not.
glm::dvec3 onPicturePlane(const Ray& ray, const view::Camera& camera, glm::dvec3 point);

// The points of a body that may be grabbed.
struct BodyPoints {
    std::string name;                   // "cloth.curtain", the name of its surfaces too
    std::vector<int> points;            // (points) their numbers in the order of authoring
    std::vector<glm::dvec3> positions;  // (points) [m]
};

struct PickedPoint {
    std::string body;
    int point = 0;  // in the order of authoring
    glm::dvec3 position{0.0};
};

// As scenes and checks name it: "cloth.curtain@#12".
std::string nameOf(const PickedPoint& picked);

// How far beside a body a point may still be meant [m for each metre of distance].
inline constexpr double pickReach = 0.03;

// The point nearest to the ray. If the ray hits a body, it is a point of that body. Otherwise it is a point within
// `reach` [m per metre of distance] of the ray that nothing opaque hides. None if a collider is in the way, or nothing
// is near.
std::optional<PickedPoint> pick(const Ray& ray, std::span<const view::Surface> surfaces,
                                std::span<const BodyPoints> bodies, double reach);

}  // namespace taut::live
