#include <cmath>

#include "core/error.h"
#include "core/trig.h"
#include "mechanics/builder_support.h"
#include "mechanics/builders.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;

// P(s) = start + s chord + 4 depth s (1 - s) sag: hangs between the ends s = 0 and s = 1, goes on beyond them.
struct Parabola {
    dvec3 start, chord, sag;
    double depth = 0.0;  // [m]

    dvec3 at(double s) const { return start + s * chord + (4.0 * depth * s * (1.0 - s)) * sag; }

    // The first parameter after s whose point lies `reach` away in a straight line. |P'| <= |chord| + 4 depth up to
    // s = 1, so a step of (what is missing) / that bound never jumps over it.
    double next(double s, double reach) const {
        const double fastest = glm::length(chord) + 4.0 * depth;
        const dvec3 from = at(s);
        double to = s + reach / fastest;
        for (int i = 0; i < 400 && to < 1.0; ++i) {
            const double missing = reach - glm::length(at(to) - from);
            if (!(missing > 1e-15 * reach)) break;
            to += missing / fastest;
        }
        return to;
    }
};

// Where a chain of `links` chords of the same length, laid along the parabola from its start, comes to [-].
double endOfChain(const Parabola& parabola, int links, double link) {
    double s = 0.0;
    for (int i = 0; i < links && s < 1.0; ++i) s = parabola.next(s, link);
    return s;
}

// Any unit vector at a right angle to v, v not zero.
dvec3 perpendicularTo(dvec3 v) {
    const dvec3 axis = std::abs(v.x) <= std::abs(v.z) ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
    return glm::normalize(glm::cross(v, axis));
}

// Both ends in one place: a regular polygon that hangs from it. Its corner i stands at the angle 2 π i / n.
void hangRing(const RopeShape& shape, double link, std::vector<dvec3>& positions) {
    const int n = shape.segments;
    const dvec3 side = perpendicularTo(shape.sag);
    const double radius = link / (2.0 * core::sine(core::pi / n));
    for (int i = 1; i < n; ++i) {
        const double angle = 2.0 * core::pi * i / n;
        positions[static_cast<std::size_t>(i)] =
            shape.start + radius * ((1.0 - core::cosine(angle)) * shape.sag + core::sine(angle) * side);
    }
}

// Slack: every chord has the natural length of its spring, so that the rope starts without strain.
void hangParabola(const RopeShape& shape, double link, std::vector<dvec3>& positions) {
    const dvec3 chord = shape.end - shape.start;
    Parabola parabola{shape.start, chord, shape.sag};
    // A rope that slackens along itself bows out sideways instead.
    if (glm::length(glm::cross(chord, shape.sag)) < 1e-3 * glm::length(chord)) parabola.sag = perpendicularTo(chord);
    double shallow = 0.0, deep = link * shape.segments;
    for (int i = 0; i < 60; ++i) {
        parabola.depth = 0.5 * (shallow + deep);
        (endOfChain(parabola, shape.segments, link) < 1.0 ? deep : shallow) = parabola.depth;
    }
    double s = 0.0;
    for (int i = 1; i < shape.segments; ++i) {
        s = parabola.next(s, link);
        positions[static_cast<std::size_t>(i)] = parabola.at(s);
    }
}

void placePoints(const RopeShape& shape, double distance, double length, std::vector<dvec3>& positions) {
    const int n = shape.segments;
    positions.front() = shape.start;
    positions.back() = shape.end;
    if (n > 1 && length > distance * (1.0 + 1e-9)) {
        if (distance < 1e-9 * length)
            hangRing(shape, length / n, positions);
        else
            hangParabola(shape, length / n, positions);
    } else {
        for (int i = 1; i < n; ++i)
            positions[static_cast<std::size_t>(i)] =
                shape.start + (shape.end - shape.start) * (static_cast<double>(i) / n);
    }
    for (dvec3& p : positions) p = detail::withoutNegativeZero(p);
}

}  // namespace

// k = EA/ℓ: a link of length ℓ under the tension EA ε grows by ε ℓ. A span-2 spring is a link of length 2ℓ.
Model buildRope(const RopeShape& shape) {
    TAUT_EXPECTS(shape.segments >= 1 && shape.mass > 0.0 && shape.length >= 0.0);
    const int n = shape.segments;
    const double distance = glm::length(shape.end - shape.start);
    const double length = shape.length > 0.0 ? shape.length : distance;
    if (!(length > 0.0)) throw core::Error(core::ExitCode::badContent, "a rope needs a length or two distinct ends");
    const double link = length / n;

    Model model;
    detail::addRestingPoints(model, n + 1, shape.dragRate);
    placePoints(shape, distance, length, model.positions);
    for (int i = 0; i <= n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const bool isEnd = i == 0 || i == n;
        model.masses[at] =
            shape.lumping == Lumping::uniform ? shape.mass / (n + 1) : shape.mass / n * (isEnd ? 0.5 : 1.0);
        model.uv[at] = {link * i, 0.0};
    }

    for (int i = 0; i < n; ++i)
        model.springs.push_back({i, i + 1, shape.stretch / link, link, shape.dampingTime, SpringKind::structural});
    if (shape.bend > 0.0)
        for (int i = 0; i + 2 <= n; ++i)
            model.springs.push_back(
                {i, i + 2, shape.bend / (2.0 * link), 2.0 * link, shape.dampingTime, SpringKind::bend});

    model.groups["start"] = {0};
    model.groups["end"] = {n};
    model.groups["ends"] = {0, n};
    return model;
}

}  // namespace taut::mechanics
