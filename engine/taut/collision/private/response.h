// What a touch does to a point: projection, the normal impulse with restitution, Coulomb friction. It knows no shapes.
#pragma once

#include "taut/collision/geometry.h"

namespace taut::collision {

// A point during a step, in the world.
struct MovingPoint {
    dvec3 before;        // [m]
    dvec3 x;             // [m]
    dvec3 v;             // [m/s]
    bool rests = false;  // x is `before`, to the bit
};

// How the touched surface moves and what it is made of.
struct MovingSurface {
    const Frame& from;
    const Frame& to;
    bool still;          // from and to are the same
    double friction;     // Coulomb's μ of point and surface [-]
    double restitution;  // [-]
    double h;            // [s] length of the step
    double restSpeed;    // [m/s] slower arrivals do not bounce
    double fastest;      // [m/s] limit of the surface's speed
};

struct Impact {
    double impulse;  // normal, per mass [m/s]
    dvec3 position;  // on the surface [m]
    dvec3 normal;
    dvec3 carried;  // velocity of the surface [m/s]
    bool shifted;   // x moved by more than rounding
};

// The velocity of the surface's place that ends the step at `place`: its way during the step over h.
inline dvec3 surfaceVelocity(const MovingSurface& surface, const dvec3& place) {
    if (surface.still) return dvec3(0.0);
    const dvec3 v = (place - surface.from.toWorld(surface.to.toLocal(place))) / surface.h;
    const double speed = std::sqrt(glm::dot(v, v));
    return speed > surface.fastest ? v * (surface.fastest / speed) : v;
}

//      from o           The path in the world, its start carried along by the surface. `fall` is how far it goes
//            \          against the normal, `pressed` the part of that after the touch. Friction acts on the way along
//   ----------x-------  the surface after the touch as it does on the velocity: it undoes as much of this way as
//              \        μ times `pressed` allows. So a point that sticks is where it was. It does not creep down a
//            to o       slope by what gravity adds in a step.
//
// Returns false if there is nothing to report. Then `impact` means nothing.
inline bool respond(const MovingSurface& surface, const Path& path, const HalfSpace& touch, MovingPoint& point,
                    Impact& impact) {
    const dvec3& n = touch.normal;
    const double depth = touch.offset - glm::dot(n, path.to);
    if (!(depth > -path.skin)) return false;
    const double out = depth > 0.0 ? depth : 0.0;
    const dvec3 onSurface = path.to + (out - path.thickness) * n;

    // Velocity relative to the surface: the normal part is removed or bounces, if it approaches. Friction slows the
    // rest.
    const dvec3 carried = surfaceVelocity(surface, onSurface);
    const dvec3 u = point.v - carried;
    const double un = glm::dot(u, n);
    if (depth <= 0.0 && !(un < 0.0)) return false;
    const double bounce = un < -surface.restSpeed ? surface.restitution : 0.0;
    impact.impulse = un < 0.0 ? -(1.0 + bounce) * un : 0.0;
    const dvec3 slide = u - un * n;
    const double slideSquare = glm::dot(slide, slide);
    const double grip = surface.friction * impact.impulse;
    const bool sticks = slideSquare <= grip * grip;
    if (sticks && bounce == 0.0 && un < 0.0) {
        point.v = carried;
    } else {
        point.v += impact.impulse * n;
        if (sticks)
            point.v -= slide;
        else if (grip > 0.0)
            point.v -= slide * (grip / std::sqrt(slideSquare));
    }

    // Position: out along the normal, and back along the surface by friction.
    const dvec3 way = path.to - path.from;
    const double fall = -glm::dot(way, n);
    double pressed = depth + path.skin < fall ? depth + path.skin : fall;
    if (!(pressed > 0.0)) pressed = 0.0;
    dvec3 end = path.to + (out + bounce * pressed) * n;
    bool holds = false;
    if (pressed > 0.0 && surface.friction > 0.0) {
        const dvec3 along = (way + fall * n) * (pressed / fall);
        const double square = glm::dot(along, along);
        const double limit = surface.friction * pressed * (1.0 + bounce);
        holds = square <= limit * limit;
        end -= holds ? along : along * (limit / std::sqrt(square));
    }
    // A point that friction held, and that stood within rounding of the surface, stays to the bit. So rounding cannot
    // add up.
    const double startHeight = glm::dot(n, path.from) - touch.offset;
    point.rests = holds && sticks && surface.still && bounce == 0.0 && std::abs(startHeight) <= path.skin;
    point.x = point.rests ? point.before : end;

    impact.shifted = depth > path.skin || bounce > 0.0;
    impact.position = onSurface;
    impact.normal = n;
    impact.carried = carried;
    return impact.impulse > 0.0 || depth > path.skin;
}

}  // namespace taut::collision
