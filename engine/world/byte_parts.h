// What the bytes of a world are made of besides numbers and texts, and how they are refused.
#pragma once

#include <cmath>
#include <string>

#include "taut/collision/colliders.h"
#include "taut/core/bytes.h"
#include "taut/mechanics/linear_path.h"

namespace taut::world {

[[noreturn]] inline void misfit(const std::string& what) {
    throw core::Error(core::ExitCode::badContent, "the bytes are not of this scene: " + what);
}

inline void require(bool condition) {
    if (!condition) core::ByteReader::fail();
}

inline double finite(core::ByteReader& bytes) {
    const double number = bytes.number<double>();
    require(std::isfinite(number));
    return number;
}
inline double notNegative(core::ByteReader& bytes) {
    const double number = finite(bytes);
    require(number >= 0);
    return number;
}

inline void addVector(core::ByteWriter& bytes, const glm::dvec3& v) {
    for (int p = 0; p < 3; ++p) bytes.add(v[p]);
}
inline glm::dvec3 vector(core::ByteReader& bytes) {
    glm::dvec3 v;
    for (int p = 0; p < 3; ++p) v[p] = finite(bytes);
    return v;
}

inline void addPath(core::ByteWriter& bytes, const mechanics::LinearPath& path) {
    addVector(bytes, path.from);
    addVector(bytes, path.to);
    bytes.add(path.t0);
    bytes.add(path.t1);
    bytes.add(path.isLine);
}
inline mechanics::LinearPath path(core::ByteReader& bytes) {
    mechanics::LinearPath p;
    p.from = vector(bytes);
    p.to = vector(bytes);
    p.t0 = finite(bytes);
    p.t1 = finite(bytes);
    p.isLine = bytes.number<bool>();
    return p;
}

inline void addPose(core::ByteWriter& bytes, const collision::Pose& pose) {
    addVector(bytes, pose.position);
    for (double number : {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z}) bytes.add(number);
}
inline collision::Pose pose(core::ByteReader& bytes) {
    collision::Pose p;
    p.position = vector(bytes);
    for (double* number : {&p.rotation.w, &p.rotation.x, &p.rotation.y, &p.rotation.z}) *number = finite(bytes);
    const double length2 = glm::dot(p.rotation, p.rotation);
    require(length2 > 0.25 && length2 < 4.0);
    return p;
}

}  // namespace taut::world
