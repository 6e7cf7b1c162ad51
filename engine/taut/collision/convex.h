// A convex shape in contact with other convex shapes: a Bullet shape, and the faces that support it. Never changes once
// built: bodies share it, also from several threads.
//
//      _________        The core is smaller than the shape by the rounding r on all sides. Distances are between cores,
//     / _______ \       so that two shapes that touch, or overlap by less than both roundings, are still apart for
//    | |       | |      Bullet, whose answers are exact then.
//    | |  core | | r
//     \ ------- /
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "taut/collision/closed_shape.h"
#include "taut/collision/geometry.h"

class btConvexShape;

namespace taut::collision {

class Form;

// Corners of the core that support it in a direction: of a face, in order around it; of an edge both ends; or one.
class SupportingFace {
  public:
    static constexpr int most = 32;
    bool isRim = false;  // its edges stand for a circle
    void add(const dvec3& corner) {
        if (count_ < most) corners_[count_++] = corner;
    }
    int count() const { return count_; }
    dvec3& operator[](int i) { return corners_[i]; }
    const dvec3& operator[](int i) const { return corners_[i]; }
    std::span<const dvec3> corners() const { return {corners_.data(), static_cast<std::size_t>(count_)}; }
    std::span<dvec3> corners() { return {corners_.data(), static_cast<std::size_t>(count_)}; }

  private:
    std::array<dvec3, most> corners_;
    int count_ = 0;
};

class Convex {
  public:
    virtual ~Convex();
    Convex(const Convex&) = delete;
    Convex& operator=(const Convex&) = delete;

    // direction: unit, in the shape's own axes.
    virtual SupportingFace faceTowards(const dvec3& direction) const = 0;
    // The whole shape's distance as a formula, if it has one.
    virtual ClosedShape closed() const { return {}; }
    // The form for points; by default closed(). Expects a shape that is not rounded, or is a sphere or a capsule.
    virtual std::shared_ptr<const Form> form() const;
    // The place of the core that is furthest in a direction [m].
    dvec3 support(const dvec3& direction) const;
    // [m] Of the whole shape; none: it is a half-space, whose plane goes through the origin.
    const std::optional<core::Aabb>& bounds() const { return bounds_; }
    bool isHalfSpace() const { return !bounds_; }
    const dvec3& up() const { return up_; }        // unit, out of a half-space
    double rounding() const { return rounding_; }  // [m]

    // In units of 1/4096 m, about `offset` [m] of the shape's own axes; null: it is a half-space. Bullet's tolerances
    // are lengths, which in metres spoil bodies below 10 cm.
    static constexpr double unit = 4096.0;
    const btConvexShape* bullet() const { return bullet_.get(); }
    const dvec3& offset() const { return offset_; }

  protected:
    Convex(std::unique_ptr<btConvexShape> bullet, double rounding, const dvec3& offset = dvec3(0.0));
    explicit Convex(const dvec3& up);

  private:
    std::unique_ptr<btConvexShape> bullet_;
    double rounding_ = 0.0;
    dvec3 offset_{0.0}, up_{0.0};
    std::optional<core::Aabb> bounds_;
};

struct PlacedConvex {
    std::shared_ptr<const Convex> shape;
    Frame at;
};
struct ConvexParts {
    std::vector<PlacedConvex> shapes;
    bool areAll = false;  // there is no other part
};

// Where two convex shapes touch, or come near to each other: up to four places along one normal.
struct Manifold {
    static constexpr int most = 4;
    struct Place {
        dvec3 onA, onB;  // [m] on the surfaces
        double gap;      // [m] along the normal; negative: they overlap
    };
    dvec3 normal{0.0};  // unit, from B towards A
    std::array<Place, most> of;
    int count = 0;
    std::span<const Place> places() const { return {of.data(), static_cast<std::size_t>(count)}; }
};

// A pure function of the two poses: places whose gap is below `reach` [m]. Bullet's GJK and EPA find the normal and the
// nearest place. The supporting faces of the two sides, clipped against each other, give the others. Exact to rounding
// for cores that are apart; of cores that overlap, the depth is good to 1e-5 of the size. No manifold is kept from call
// to call.
Manifold manifoldOf(const Convex& a, const Frame& atA, const Convex& b, const Frame& atB, double reach);

}  // namespace taut::collision
