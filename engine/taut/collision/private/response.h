// The effect of a contact on a point: projection, the normal impulse with restitution, Coulomb friction. Independent of
// shapes. One text for one point and for several at once: V is double, or a vector with a lane for each point.
#pragma once

#include "taut/core/private/vectors.h"

namespace taut::collision::TAUT_ISA {
namespace {

using core::TAUT_ISA::either;
using core::TAUT_ISA::Triple;

struct Surface {
    bool still;
    double friction;     // Coulomb's μ of point and surface [-]
    double restitution;  // [-]
    double restSpeed;    // [m/s] slower arrivals do not bounce
};

// The path of a point in the world, and the half-space normal · p >= offset in which it has to end.
template <class V>
struct Touch {
    Triple<V> from;  // carried along by the surface [m]
    Triple<V> to;    // [m]
    Triple<V> v;     // of the point [m/s]
    Triple<V> normal;
    V offset;           // [m]
    V skin;             // [m] rounding error of a distance
    Triple<V> carried;  // velocity of the surface [m/s], 0 of a still one
};

template <class V>
struct Response {
    using Mask = decltype((V{} < V{}) & (V{} < V{}));
    Mask arrives;  // else all of this means nothing
    Mask reports;  // the touch is worth a report
    Mask isMoved;  // by more than rounding
    Triple<V> x;   // [m]
    Triple<V> v;   // [m/s]
    V impulse;     // normal, per mass [m/s]
};

// The place on the surface under the end of a path.
template <class V>
inline Triple<V> placeUnder(const Triple<V>& to, const Triple<V>& normal, const V& offset, double thickness) {
    const V depth = offset - dot(normal, to), none{}, out = depth > none ? depth : none;
    return to + (out - thickness) * normal;
}

//      from o           The path in the world, its start carried along by the surface. `fall` is how far it goes
//            \          against the normal, `pressed` the part of that after the touch. Friction acts on the way along
//   ----------x-------  the surface after the touch as it does on the velocity: it undoes as much of this path as
//              \        μ times `pressed` allows. So a point that sticks is where it was. It does not creep down a
//            to o       slope by the motion that gravity adds in a step.
template <class V>
inline Response<V> respond(const Surface& surface, const Touch<V>& touch) {
    using core::TAUT_ISA::isAny;
    using core::TAUT_ISA::root;
    const V none{}, one = none + 1.0;
    const Triple<V>& n = touch.normal;
    const V depth = touch.offset - dot(n, touch.to), out = depth > none ? depth : none;

    // Velocity relative to the surface: the normal part is removed or bounces, if it approaches. Friction slows the
    // rest.
    const Triple<V> u = touch.v - touch.carried;
    const V un = dot(u, n);
    const V bounce = un < -surface.restSpeed ? none + surface.restitution : none;
    const V impulse = un < none ? -(one + bounce) * un : none;
    const Triple<V> slide = u - un * n;
    const V slideSquare = dot(slide, slide), grip = surface.friction * impulse;
    const auto arrives = (depth > -touch.skin) & ((depth > none) | (un < none));
    const auto sticks = slideSquare <= grip * grip;
    V part = one;
    if (isAny(arrives & (sticks == 0))) part = sticks ? one : grip / root(slideSquare);
    const Triple<V> pushed = touch.v + impulse * n;
    const auto stops = sticks & (bounce == none) & (un < none);
    const Triple<V> v = either(stops, touch.carried, either(part > none, pushed - part * slide, pushed));

    // Position: out along the normal, and back along the surface by friction.
    const Triple<V> way = touch.to - touch.from;
    const V fall = -dot(way, n), deep = depth + touch.skin, least = deep < fall ? deep : fall;
    const V pressed = least > none ? least : none;
    Triple<V> x = touch.to + (out + bounce * pressed) * n;
    if (surface.friction > 0.0) {
        const auto rubs = pressed > none;
        const Triple<V> along = (pressed / fall) * (way + fall * n);
        const V square = dot(along, along), limit = surface.friction * pressed * (one + bounce);
        const auto holds = square <= limit * limit;
        V back = one;
        if (isAny(arrives & (holds == 0))) back = holds ? one : limit / root(square);
        x = either(rubs, x - back * along, x);
        // A point that friction held, and that stood within rounding of the surface, stays to the bit. So rounding
        // cannot add up.
        if (surface.still) {
            const V height = dot(n, touch.from) - touch.offset;
            const auto stood = (height <= touch.skin) & (height >= -touch.skin);
            x = either(rubs & holds & sticks & (bounce == none) & stood, touch.from, x);
        }
    }
    return {arrives, arrives & ((impulse > none) | (depth > touch.skin)), (depth > touch.skin) | (bounce > none), x, v,
            impulse};
}

}  // namespace
}  // namespace taut::collision::TAUT_ISA
