// Common code of the collision tests: one point mass flown by leap-frog against colliders, and shapes to throw it at.
#pragma once

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/shape_table.h"
#include "taut/core/trig.h"

namespace taut::collision {

inline constexpr double gravity = 9.81;  // [m/s²]

template <class Real>
inline constexpr bool isFloat = sizeof(Real) == sizeof(float);

// The same numbers on every machine: a linear congruential generator (Knuth's MMIX constants).
class Numbers {
  public:
    double next(double low, double high) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return low + (high - low) * static_cast<double>(state_ >> 11) / 9007199254740992.0;
    }
    glm::dvec3 point(double size) {
        const double x = next(-size, size);
        const double y = next(-size, size);
        return {x, y, next(-size, size)};
    }

  private:
    std::uint64_t state_ = 1;
};

// One point with its state in Real; a step is symplectic Euler, which for a constant force is leap-frog.
template <class Real>
struct Flyer {
    Real before[3]{};
    Real x[3]{};
    Real v[3]{};
    Real inverseMass = 1;
    double thickness = 0.0;
    double friction = 1.0;
    double fall = gravity;  // [m/s²]
    std::vector<Contact> contacts;

    explicit Flyer(const glm::dvec3& position, const glm::dvec3& velocity = glm::dvec3(0.0)) {
        for (int k = 0; k < 3; ++k) {
            before[k] = x[k] = static_cast<Real>(position[k]);
            v[k] = static_cast<Real>(velocity[k]);
        }
    }
    void fly(double h, const glm::dvec3& acceleration = glm::dvec3(0.0)) {
        for (int k = 0; k < 3; ++k) {
            before[k] = x[k];
            v[k] += static_cast<Real>(h * acceleration[k]);
            x[k] += static_cast<Real>(h) * v[k];
        }
    }
    void resolve(const Colliders& colliders, double h) {
        contacts.clear();
        MovingPoints<Real> points;
        points.last = 1;
        points.stride = 1;
        points.xBefore = before;
        points.x = x;
        points.v = v;
        points.inverseMass = &inverseMass;
        points.thickness = thickness;
        points.friction = friction;
        points.gravity = fall;
        colliders.resolve(points, h, contacts);
    }
    void step(const Colliders& colliders, double h, const glm::dvec3& acceleration = glm::dvec3(0.0)) {
        fly(h, acceleration);
        resolve(colliders, h);
    }
    glm::dvec3 position() const { return {x[0], x[1], x[2]}; }
    glm::dvec3 velocity() const { return {v[0], v[1], v[2]}; }
};

inline glm::dquat turned(const glm::dvec3& axis, double angle) {
    return {core::cosine(0.5 * angle), core::sine(0.5 * angle) * glm::normalize(axis)};
}

// The sizes of a shape and the name of its kind, or parts: made when it is added to colliders.
struct SizedShape : ShapeSizes {
    struct Part;

    std::string kind = "sphere";
    std::vector<Part> parts;

    operator Shape() const;
};
struct SizedShape::Part {
    SizedShape shape;
    Pose pose;
};
inline SizedShape::operator Shape() const {
    Shape made;
    if (kind != "compound") made = builtInShapes().find(kind)->shape(*this);
    for (const Part& part : parts) made.parts.push_back({part.shape, part.pose});
    return made;
}

inline SizedShape planeShape(const glm::dvec3& normal = {0.0, 1.0, 0.0}) {
    SizedShape shape;
    shape.kind = "plane";
    shape.normal = normal;
    return shape;
}
inline SizedShape boxShape(const glm::dvec3& halfSize) {
    SizedShape shape;
    shape.kind = "box";
    shape.halfSize = halfSize;
    return shape;
}
inline SizedShape roundShape(const std::string& kind, double radius, double height = 1.0) {
    SizedShape shape;
    shape.kind = kind;
    shape.radius = radius;
    shape.height = height;
    return shape;
}
// The eight corners of a box, and its twelve triangles, counter-clockwise seen from outside.
inline SizedShape boxHull(const glm::dvec3& half) {
    SizedShape shape;
    shape.kind = "hull";
    for (int i = 0; i < 8; ++i)
        shape.vertices.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                    (i & 4) != 0 ? half.z : -half.z);
    return shape;
}
inline SizedShape boxMesh(const glm::dvec3& half) {
    SizedShape shape = boxHull(half);
    shape.kind = "mesh";
    shape.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return shape;
}
// A square in the plane y = 0, `cells` by `cells`, without thickness.
inline SizedShape sheetMesh(double half, std::uint32_t cells) {
    SizedShape shape;
    shape.kind = "mesh";
    for (std::uint32_t i = 0; i <= cells; ++i)
        for (std::uint32_t j = 0; j <= cells; ++j)
            shape.vertices.emplace_back(half * (2.0 * i / cells - 1.0), 0.0, half * (2.0 * j / cells - 1.0));
    for (std::uint32_t i = 0; i < cells; ++i) {
        for (std::uint32_t j = 0; j < cells; ++j) {
            const std::uint32_t a = i * (cells + 1) + j;
            const std::uint32_t c = a + cells + 1;
            shape.triangles.insert(shape.triangles.end(), {a, a + 1, c, c, a + 1, c + 1});
        }
    }
    return shape;
}
inline SizedShape compoundOf(const SizedShape& shape, const Pose& pose = {}) {
    SizedShape compound;
    compound.kind = "compound";
    compound.parts.push_back({shape, pose});
    return compound;
}

// Vertices and triangles (faces as fans) of an OBJ file; empty if there is none.
inline SizedShape readObj(const std::string& path, const std::string& kind) {
    SizedShape shape;
    shape.kind = kind;
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            glm::dvec3 v(0.0);
            words >> v.x >> v.y >> v.z;
            shape.vertices.push_back(v);
        } else if (word == "f") {
            std::vector<std::uint32_t> corners;
            while (words >> word) corners.push_back(static_cast<std::uint32_t>(std::stoul(word)) - 1);
            for (std::size_t i = 2; i < corners.size(); ++i)
                shape.triangles.insert(shape.triangles.end(), {corners[0], corners[i - 1], corners[i]});
        }
    }
    return shape;
}

}  // namespace taut::collision
