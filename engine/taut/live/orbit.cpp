#include "taut/live/orbit.h"

#include <algorithm>
#include <cmath>

namespace taut::live {
namespace {

constexpr double steepest = 1.5;                    // [rad] over the horizon: at the pole right and left are lost
constexpr double nearest = 0.05, farthest = 150.0;  // [m]

}  // namespace

void Orbit::turn(double right, double up, const view::Camera& from) {
    if (!own_) own_ = from;
    const glm::dvec3 arm = glm::dvec3(own_->eye) - glm::dvec3(own_->target);
    const double distance = std::max(glm::length(arm), nearest);
    const double azimuth = std::atan2(arm.x, arm.z) - right;
    const double height = std::clamp(std::asin(std::clamp(arm.y / distance, -1.0, 1.0)) + up, -steepest, steepest);
    const glm::dvec3 turned(std::sin(azimuth) * std::cos(height), std::sin(height),
                            std::cos(azimuth) * std::cos(height));
    own_->eye = own_->target + glm::vec3(distance * turned);
}

void Orbit::zoom(double factor, const view::Camera& from) {
    if (!own_) own_ = from;
    const glm::dvec3 arm = glm::dvec3(own_->eye) - glm::dvec3(own_->target);
    const double distance = glm::length(arm);
    if (!(distance > 0.0)) return;
    own_->eye = own_->target + glm::vec3(arm * (std::clamp(distance * factor, nearest, farthest) / distance));
}

}  // namespace taut::live
