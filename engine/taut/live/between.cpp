#include "taut/live/between.h"

#include <algorithm>
#include <cmath>

namespace taut::live {
namespace {

std::shared_ptr<const view::Geometry> blended(const view::Geometry& a, const view::Geometry& b, float share) {
    view::Geometry result;
    result.positions.resize(b.positions.size());
    result.normals.resize(b.normals.size());
    for (std::size_t i = 0; i < b.positions.size(); ++i)
        result.positions[i] = glm::mix(a.positions[i], b.positions[i], share);
    for (std::size_t i = 0; i < b.normals.size(); ++i) {
        const glm::vec3 normal = glm::mix(a.normals[i], b.normals[i], share);
        const float square = glm::dot(normal, normal);
        result.normals[i] = square > 1e-12F ? normal / std::sqrt(square) : b.normals[i];
    }
    return std::make_shared<const view::Geometry>(std::move(result));
}

// A way in one tick is short: the mean of two turns is a turn but for a factor, which the columns' lengths restore.
glm::mat4 blended(const glm::mat4& a, const glm::mat4& b, float share) {
    glm::mat4 result = a + share * (b - a);
    for (int c = 0; c < 3; ++c) {
        const float is = glm::length(glm::vec3(result[c])), was = glm::length(glm::vec3(b[c]));
        if (is > 1e-6F) result[c] *= was / is;
    }
    return result;
}

bool isSameThing(const view::Surface& a, const view::Surface& b) {
    return a.name == b.name && a.topology == b.topology && a.geometry && b.geometry &&
           a.geometry->positions.size() == b.geometry->positions.size() &&
           a.geometry->normals.size() == b.geometry->normals.size();
}

void blendSurfaces(const view::FrameView& before, float share, view::FrameView& result) {
    const std::size_t both = std::min(before.surfaces.size(), result.surfaces.size());
    for (std::size_t i = 0; i < both; ++i) {
        const view::Surface& from = before.surfaces[i];
        view::Surface& to = result.surfaces[i];
        if (!isSameThing(from, to)) continue;
        if (from.geometry != to.geometry) to.geometry = blended(*from.geometry, *to.geometry, share);
        if (from.transform != to.transform) to.transform = blended(from.transform, to.transform, share);
    }
}

void blendMarks(const view::FrameView& before, float share, view::FrameView& result) {
    if (before.marks.lines.size() == result.marks.lines.size())
        for (std::size_t i = 0; i < result.marks.lines.size(); ++i) {
            view::Marks::Line& line = result.marks.lines[i];
            line.from = glm::mix(before.marks.lines[i].from, line.from, share);
            line.to = glm::mix(before.marks.lines[i].to, line.to, share);
        }
    if (before.marks.dots.size() == result.marks.dots.size())
        for (std::size_t i = 0; i < result.marks.dots.size(); ++i)
            result.marks.dots[i].at = glm::mix(before.marks.dots[i].at, result.marks.dots[i].at, share);
}

}  // namespace

view::FrameView between(const view::FrameView& before, const view::FrameView& now, double share) {
    view::FrameView result = now;
    const auto part = static_cast<float>(std::clamp(share, 0.0, 1.0));
    if (part >= 1.0F) return result;
    result.time = before.time + share * (now.time - before.time);
    result.camera.eye = glm::mix(before.camera.eye, now.camera.eye, part);
    result.camera.target = glm::mix(before.camera.target, now.camera.target, part);
    result.camera.fieldOfView = glm::mix(before.camera.fieldOfView, now.camera.fieldOfView, part);
    blendSurfaces(before, part, result);
    blendMarks(before, part, result);
    return result;
}

}  // namespace taut::live
