#include "taut/drawing/private/tie_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "taut/drawing/drawing.h"
#include "taut/view/private/tube.h"

namespace taut::world {
namespace {

constexpr int sides = 10;
constexpr int pointsPerTurn = 16;

// A unit vector across the axis.
glm::vec3 across(const glm::vec3& axis) {
    const glm::vec3 helper = std::abs(axis.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(axis, helper));
}

}  // namespace

TieDrawing::TieDrawing(const JointSpec& joint, int number)
    : name_("joint." + (joint.name.empty() ? std::to_string(number) : joint.name)),
      mayLetGo_(joint.mayLetGo()),
      look_(joint.look),
      finish_(finishOf(*look_.finish)) {
    const auto points = static_cast<int>(line({0, 0, 0}, {1, 0, 0}).size());
    topology_ =
        std::make_shared<view::Topology>(view::tubeTopology(points, 1, sides, 1.0F, static_cast<float>(look_.radius)));
}

bool TieDrawing::isShown(const glm::vec3& a, const glm::vec3& b) const {
    return look_.turns == 0 || glm::distance(a, b) > 2.0F * static_cast<float>(look_.coil);
}

// Half a turn at each end leads from the axis to the coil.
std::vector<glm::vec3> TieDrawing::line(const glm::vec3& a, const glm::vec3& b) const {
    const glm::vec3 way = b - a;
    const float length = glm::length(way);
    const int steps = look_.turns * pointsPerTurn;
    std::vector<glm::vec3> line{a};
    const glm::vec3 axis = length > 0 ? way / length : glm::vec3(0, 1, 0), side = across(axis);
    const glm::vec3 other = glm::cross(axis, side);
    for (int i = 1; i < steps; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(steps);
        const float turned = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / pointsPerTurn;
        const float fromEnd = static_cast<float>(std::min(i, steps - i)) / (0.5F * pointsPerTurn);
        const float radius = static_cast<float>(look_.coil) * std::min(fromEnd, 1.0F);
        line.push_back(a + share * way + radius * (std::cos(turned) * side + std::sin(turned) * other));
    }
    line.push_back(b);
    return line;
}

view::Surface TieDrawing::surface(const glm::vec3& a, const glm::vec3& b, int number) const {
    view::Surface surface;
    surface.name = name_ + (mayLetGo_ ? "." + std::to_string(number) : "");
    surface.topology = topology_;
    const auto radius = static_cast<float>(look_.radius);
    surface.geometry = std::make_shared<view::Geometry>(view::tubeGeometry(line(a, b), 1, sides, radius));
    surface.finish = finish_;
    surface.tubeRadius = radius;
    return surface;
}

}  // namespace taut::world
