// The response to a touch, in a loop over a batch. It is part of contact_kernel.cpp, compiled once for each instruction
// set.
#pragma once

#include "taut/collision/private/contact_kernel.h"
#include "taut/collision/private/response.h"
#include "taut/core/private/vectorise.h"

namespace taut::collision::TAUT_ISA {
namespace {

using core::TAUT_ISA::load;
using core::TAUT_ISA::select;
using core::TAUT_ISA::store;
using Row = double[contactRow];
using Rows = Row[3];

// A loop of its own: inside the loops that set `outcome` it would keep compilers from vectorising them.
inline std::int64_t anyOf(const std::int64_t (&outcome)[contactRow], int n) {
    std::int64_t any = 0;
    for (int i = 0; i < n; ++i) any |= outcome[i];
    return any;
}

// respond() for the points that are near. `path` is the start of their paths, carried along by the surface. A point
// with an earlier contact (`again`) takes the result even if there is nothing to report.
inline void respondAll(const Surface& surface, const Rows& path, bool again, ContactLanes& lanes, int n) {
    using V = core::TAUT_ISA::WideVector<double>;
    constexpr int width = sizeof(V) / sizeof(double);
    const auto rows = [&](const Rows& from, int i) {
        return Triple<V>{load<V>(from[0] + i), load<V>(from[1] + i), load<V>(from[2] + i)};
    };
    const auto keep = [&](Rows& to, int i, const Triple<V>& value) {
        store(to[0] + i, value.x);
        store(to[1] + i, value.y);
        store(to[2] + i, value.z);
    };
    for (int i = 0; i < n; i += width) {
        const auto found = load<core::TAUT_ISA::WideVector<std::int64_t>>(lanes.outcome + i);
        const auto near = (found & isNear) != 0;
        if (!core::TAUT_ISA::isAny(near)) {
            store(lanes.outcome + i, found & anyLeft);
            continue;
        }
        const Touch<V> touch{rows(path, i),
                             rows(lanes.end, i),
                             rows(lanes.v, i),
                             rows(lanes.normal, i),
                             load<V>(lanes.distance + i),
                             load<V>(lanes.skin + i),
                             surface.still ? Triple<V>{} : rows(lanes.carried, i)};
        const Response<V> response = respond(surface, touch);
        const auto touched = near & response.reports, takes = again ? near & response.arrives : touched;
        keep(lanes.end, i, either(takes, response.x, touch.to));
        keep(lanes.v, i, either(takes, response.v, touch.v));
        store(lanes.impulse + i, response.impulse);
        store(lanes.isMoved + i, response.isMoved);
        store(lanes.outcome + i, (touched & anyTouched) | (found & anyLeft));
    }
}

}  // namespace
}  // namespace taut::collision::TAUT_ISA
