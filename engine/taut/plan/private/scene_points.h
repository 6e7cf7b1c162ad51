// The points of all bodies of a scene, which joints tie: their numbers, and the places that a joint names.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "taut/body/body.h"
#include "taut/body/spot.h"
#include "taut/spec/joint_spec.h"

namespace taut::world {

struct PointRef {
    int body;   // of the scene
    int point;  // of its model
};

class ScenePoints {
  public:
    // Expects at least one body. The bodies keep their models.
    explicit ScenePoints(std::span<Body* const> bodies);

    std::span<Body* const> bodies() const { return bodies_; }
    Body& body(int number) const { return *bodies_[number]; }
    std::size_t count() const;
    // Points of all bodies are numbered body by body; spots before planning have these global numbers.
    int global(PointRef p) const { return firstGlobal_[p.body] + p.point; }
    PointRef refOf(int global) const;
    // The number in the island of a planned body.
    int pointOf(PointRef p) const { return body(p.body).pointOf[p.point]; }

    dvec3 position(PointRef p) const { return body(p.body).model.positions[p.point]; }
    double distance(PointRef a, PointRef b) const;  // [m]
    // The points that a side names, each once; those of one target in the order of its bodies. Throws
    // core::Error(badContent) if there are none.
    std::vector<PointRef> named(const JointSide& side, const Source& source) const;
    // The spot of a body at a place [m], in global numbers; of a body that is not rigid the nearest point.
    Spot spotOf(int number, const dvec3& place) const;

  private:
    std::span<Body* const> bodies_;
    std::vector<int> firstGlobal_;  // (bodies)
};

}  // namespace taut::world
