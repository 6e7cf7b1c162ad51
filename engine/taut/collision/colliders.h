// Contact of points with rigid shapes. It is the only door to Bullet, which no other folder includes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <span>
#include <vector>

#include "taut/core/aabb.h"
#include "taut/core/turn_friction.h"

namespace taut::collision {

struct Pose {
    glm::dvec3 position{0.0};                 // [m]
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit (w, x, y, z)
};

// If any place of a collider is faster than this [m/s], the collider counts as having jumped: see Colliders::resolve.
inline constexpr double fastestSurface = 100.0;

class Convex;
class Form;
struct FootMemory;
struct ConvexParts;

// The shape of a collider: one form (form.h), which a row of the table of shapes makes, or several parts, each with its
// pose.
struct Shape {
    std::shared_ptr<const Form> form;
    struct Part;
    std::vector<Part> parts;                 // of a compound; then there is no form
    std::shared_ptr<const Convex> convex{};  // for contact with other convex shapes; null: it is not convex
};
struct Shape::Part {
    Shape shape;
    Pose pose;
};

struct Material {
    double friction = 0.3;     // Coulomb's μ [-]
    double restitution = 0.0;  // 0 … 1: speed after a bounce / speed before [-]
    core::TurnFriction turnFriction{};
};

// The points of one body during one step, planar: x plane, y plane, z plane, each `stride` long.
template <class Real>
struct MovingPoints {
    int first = 0;  // the body's points are first … last - 1
    int last = 0;
    int stride = 0;
    const Real* xBefore = nullptr;      // (3 · stride) [m] at the start of the step
    Real* x = nullptr;                  // (3 · stride) [m] at its end: projected out of the shapes
    Real* v = nullptr;                  // (3 · stride) [m/s] over the step: changed by the contact impulse
    const Real* inverseMass = nullptr;  // (stride) [1/kg]; 0 is a held point, which is left alone
    double thickness = 0.0;             // [m] distance that the points keep from a surface
    double friction = 1.0;              // factor on the collider's friction [-]
    double restitution = 1.0;           // factor on its restitution [-]
    double gravity = 9.81;              // [m/s²] size of the acceleration by uniform fields
};

struct Contact {
    int point;  // index into the planes
    int collider;
    glm::dvec3 position;  // [m] on the surface
    glm::dvec3 normal;    // unit, away from the collider
    double impulse;       // normal impulse per mass [m/s]
    glm::dvec3 carried;   // [m/s] of the surface there
    double friction;      // Coulomb's μ of point and surface [-]
};

// The velocity [m/s] of a point after its contacts, if forces have changed the velocity since the contacts were
// resolved. The part into a surface is removed, and friction slows the part along it as in Colliders::resolve. Nothing
// bounces. Expects contacts of one point.
glm::dvec3 velocityInContact(std::span<const Contact> contacts, glm::dvec3 v);

// The places of meshes that were nearest to an island's points, which Colliders::resolve() remembers. They change the
// cost of a step, never its result.
class Feet {
  public:
    Feet() = default;
    Feet(Feet&&) noexcept = default;
    Feet& operator=(Feet&&) noexcept = default;

  private:
    friend class Colliders;
    std::shared_ptr<FootMemory> memory_;
};

class Colliders {
  public:
    Colliders();
    ~Colliders();
    Colliders(Colliders&&) noexcept;
    Colliders& operator=(Colliders&&) noexcept;

    // Returns the collider's number, counting from 0. Throws core::Error(badContent) for a compound without parts, a
    // material out of range, or a pose that is not finite. Rotations need not be of unit length.
    int add(const Shape& shape, const Material& material, const Pose& pose);
    int size() const;      // how many there are
    bool bounces() const;  // whether any has a restitution

    // A copy of the colliders that moves independently; the forms are shared.
    Colliders clone() const;

    // Sets the pose at the start and the end of the next step. It holds until the next call, so a collider that stops
    // needs one more call, with the same pose twice. A collider at rest needs no call. Between the two poses the
    // position moves straight and the rotation turns the short way. If any corner would be faster than 100 m/s, the
    // collider counts as having jumped: for this step it rests at its end, has no speed, and passes through everything
    // in between. Expects a number below size(); throws core::Error(badContent) for a pose that is not finite.
    void move(int collider, const Pose& from, const Pose& to);

    // Brings the points of one body out of all colliders at the end of a step of length h [s]. Swept: a point that
    // crosses a surface, or is overrun by a moving one, within the step ends on the side it came from. The
    // relative velocity loses its approaching normal part (or is reflected by restitution) and, by Coulomb's law,
    // tangential speed up to friction times the normal impulse. Contacts are appended in point order.
    // Const and free of shared state: bodies may be resolved side by side. Same bits on every machine.
    //
    // - Friction undoes way as well as speed, so that a point that sticks stays to the bit.
    // - A surface pushes with its own speed, up to 100 m/s. It never pulls.
    // - A point that starts the step inside goes the shortest way out of where it ends, and gains no speed by that.
    //   Of a mesh only a closed one has an inside; an open one has two sides.
    // - Arrivals slower than 2 · gravity · h do not bounce: a resting point arrives with about half of that in each
    //   step, and such a bounce would be over before the next step ends.
    // - A point that several colliders touch is tried four times against each, in the order of their numbers.
    // - Surfaces are where the shapes say, without a margin: exact for the closed forms and meshes, within 1e-12 of
    //   its size for a hull (its corners are found on rounded vertices). A mesh keeps at least 8 roundings of the
    //   coordinates (4e-6 m in float, 3e-14 m in double, a metre from the origin).
    // - Points that are not finite are left alone, for the caller to find.
    template <class Real>
    void resolve(const MovingPoints<Real>& points, double h, std::vector<Contact>& contacts) const;

    // The same for all bodies of an island, always in the same order. Points that were touched are appended to
    // `touched`, each once. Contacts are appended only if they are asked for.
    template <class Real>
    void resolve(std::span<const MovingPoints<Real>> bodies, double h, Feet& feet, std::vector<int>& touched,
                 std::vector<Contact>* contacts) const;

    // Whether a box may be touched by a collider during the step; yes if in doubt.
    bool isNear(int collider, const core::Aabb& box) const;

    // Signed distance [m] from a position to the nearest collider at its end-of-step pose; negative inside a solid or
    // a closed mesh. Infinite without colliders.
    double distance(const glm::dvec3& position) const;

    // The same with the direction in which it grows fastest, unit, if it is less than `reach` [m]; otherwise infinite.
    struct Near {
        double distance;
        glm::dvec3 away;
    };
    Near nearest(const glm::dvec3& position, double reach) const;

    // Appends the surfaces that points pass through, and colliders whose surface is nearer than their reach to their
    // end, at their end-of-step poses, in their order; for each, the points in theirs. Of a mesh only the nearest
    // place. At a point's contact the surface is the plane there. thickness [m]: contact distance. seconds: duration of
    // the paths, in which colliders move as in their steps of h [s]. It costs least if consecutive points are near each
    // other.
    struct Ways {
        std::span<const int> points;                  // numbers in the lists
        std::span<const glm::dvec3> from, to;         // [m]
        double reach;                                 // [m]
        double ahead = 0;                             // [s] the reach is longer by the motion of a point in this time
        std::span<const glm::dvec3> velocities = {};  // [m/s] not needed without
    };
    struct Surface {
        int point;
        double distance;      // [m]
        glm::dvec3 away;      // unit, in which it grows fastest
        glm::dvec3 velocity;  // [m/s] of the surface there, over a step
        glm::dvec3 spin;      // [rad/s]
        int collider;
        Material material;
    };
    void findNear(const Ways& ways, double thickness, double seconds, double h, std::vector<Surface>& found) const;

    // The collider, at its end-of-step pose, in which a ball is deepest, and how deep [m]; -1 and 0 outside all.
    struct Inside {
        int collider = -1;
        double depth = 0;
    };
    Inside inside(const glm::dvec3& centre, double radius = 0.0) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

// The convex shapes that a shape is made of, with the collider at the origin.
ConvexParts convexOf(const Shape& shape);

// The outlines of a shape's forms, one each, with the collider at the origin. Empty outlines are left out.
struct Outline;
std::vector<Outline> outlinesOf(const Shape& shape);

}  // namespace taut::collision
