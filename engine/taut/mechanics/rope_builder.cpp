#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/bisect.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/builder_support.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;

// Any unit vector at a right angle to v, v not zero.
dvec3 perpendicularTo(dvec3 v) {
    const dvec3 axis = std::abs(v.x) <= std::abs(v.z) ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
    return glm::normalize(glm::cross(v, axis));
}

// A slack rope hangs in the catenary of a chain. Link i runs along e + t_i g, with g the sag and e at a right angle to
// it. t_i = a + κ ((n - 1)/2 - i), because each mass turns the rope by the same weight over the same level tension.
// `level` and `drop` are the way from start to end along e and g, both in links.
struct Catenary {
    int links;
    double a = 0.0, kappa = 0.0;

    double slope(int i) const { return a + kappa * (0.5 * (links - 1) - i); }
    glm::dvec2 link(int i) const { return glm::dvec2(1.0, slope(i)) / std::sqrt(1.0 + slope(i) * slope(i)); }
    glm::dvec2 reach() const {
        glm::dvec2 sum(0.0);
        for (int i = 0; i < links; ++i) sum += link(i);
        return sum;
    }

    // The way down grows with a, the way along shrinks with κ.
    void fit(double level, double drop) {
        const double steepest = 1.0 / std::sqrt(1.0 - (drop / links) * (drop / links));
        kappa = core::rootOf(
            [&](double k) {
                kappa = k;
                const double most = steepest + k * links;
                a = core::rootOf(
                    [&](double slopeOffset) {
                        a = slopeOffset;
                        return drop - reach().y;
                    },
                    -most, most, 100);
                return reach().x - level;
            },
            0.0, 1e4, 100);
    }
};

// Lays the links of a slack rope along the catenary. False if there is none, because the rope is so steep or has so few
// links that it would have to fold.
bool hangCatenary(const RopeShape& shape, double link, std::vector<dvec3>& positions) {
    const dvec3 chord = shape.end - shape.start;
    const double drop = glm::dot(chord, shape.sag);
    const double level = glm::length(chord - drop * shape.sag);
    if (level < 1e-3 * link) return false;
    const dvec3 along = (chord - drop * shape.sag) / level;
    Catenary catenary{shape.segments};
    catenary.fit(level / link, drop / link);
    if (glm::length(catenary.reach() - glm::dvec2(level, drop) / link) > 1e-9 * shape.segments) return false;
    glm::dvec2 at(0.0);
    for (int i = 0; i + 1 < shape.segments; ++i) {
        at += link * catenary.link(i);
        positions[static_cast<std::size_t>(i) + 1] = shape.start + at.x * along + at.y * shape.sag;
    }
    return true;
}

// Lays links that each turn by the same angle, from a straight line to a closed ring, for any distance of the ends. The
// arc bulges along the sag, or sideways if the ends lie along the sag.
void bendArc(const RopeShape& shape, double distance, double link, std::vector<dvec3>& positions) {
    const int n = shape.segments;
    const bool isRing = distance < 1e-9 * link;
    const dvec3 chord = isRing ? perpendicularTo(shape.sag) : (shape.end - shape.start) / distance;
    dvec3 bulge = shape.sag - glm::dot(shape.sag, chord) * chord;
    bulge = glm::length(bulge) < 1e-3 ? perpendicularTo(chord) : glm::normalize(bulge);
    // n links that turn by δ end sin(nδ/2)/sin(δ/2) links away.
    const double turn = core::rootOf(
        [&](double delta) {
            return core::sine(0.5 * n * delta) / core::sine(0.5 * delta) - (isRing ? 0.0 : distance / link);
        },
        0.0, 2.0 * core::pi / n, 100);
    dvec3 at = shape.start;
    for (int i = 0; i + 1 < n; ++i) {
        const double angle = turn * (0.5 * (n - 1) - i);
        at += link * (core::cosine(angle) * chord + core::sine(angle) * bulge);
        positions[static_cast<std::size_t>(i) + 1] = at;
    }
}

// The way through given places, finely divided. It consists of Catmull and Rom's cubics, which leave each place in the
// direction from the place before to the place after it. A ring goes on from its end to its start.
std::vector<dvec3> smoothWay(const RopeShape& shape) {
    constexpr int parts = 64;
    std::vector<dvec3> places{shape.start};
    places.insert(places.end(), shape.through.begin(), shape.through.end());
    places.push_back(shape.end);
    if (shape.isClosed) places.push_back(shape.start);
    const auto last = places.size() - 1;
    const dvec3 beforeFirst = shape.isClosed ? places[last - 1] : places[0], afterLast = places[1];
    std::vector<dvec3> way{shape.start};
    for (std::size_t i = 0; i < last; ++i) {
        const dvec3 a = places[i], b = places[i + 1];
        const dvec3 leaving = i > 0 ? 0.5 * (b - places[i - 1]) : shape.isClosed ? 0.5 * (b - beforeFirst) : b - a;
        const dvec3 arriving = i + 1 < last     ? 0.5 * (places[i + 2] - a)
                               : shape.isClosed ? 0.5 * (afterLast - a)
                                                : b - a;
        for (int k = 1; k <= parts; ++k) {
            const double t = static_cast<double>(k) / parts, r = 1.0 - t;
            way.push_back(r * r * (1.0 + 2.0 * t) * a + t * t * (1.0 + 2.0 * r) * b +
                          t * r * (r * leaving - t * arriving));
        }
    }
    return way;
}

// Places points one link apart along a way, from its start. Points beyond the end go on straight. Returns how far along
// the way the last point lies [m].
double layLinks(const std::vector<dvec3>& way, double link, std::vector<dvec3>& positions) {
    std::size_t piece = 0;
    double before = 0.0, share = 0.0;
    dvec3 at = positions.front() = way.front();
    const auto step = [&](std::size_t i) { return way[i + 1] - way[i]; };
    for (std::size_t n = 1; n < positions.size(); ++n) {
        while (piece + 2 < way.size() && glm::length(way[piece + 1] - at) < link) {
            before += glm::length(step(piece));
            ++piece;
            share = 0.0;
        }
        // |way[piece] + share step - at| = link, the greater root.
        const dvec3 from = way[piece] - at, along = step(piece);
        const double a = glm::dot(along, along), b = glm::dot(from, along);
        const double rest = glm::dot(from, from) - link * link;
        if (a > 0.0) share = std::max(share, (-b + std::sqrt(std::max(b * b - a * rest, 0.0))) / a);
        at = way[piece] + share * along;
        positions[n] = at;
    }
    return before + share * glm::length(step(piece));
}

// Lays all points along a whole way, with links of one length. Returns that length.
double layAlong(const std::vector<dvec3>& way, std::vector<dvec3>& positions) {
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) length += glm::length(way[i + 1] - way[i]);
    if (!(length > 0.0)) throw core::Error(core::ErrorKind::badContent, "a rope needs places that differ");
    const double most = length / static_cast<double>(positions.size() - 1);
    const double link =
        core::rootOf([&](double l) { return length - layLinks(way, l, positions); }, 0.0, 2.0 * most, 60);
    layLinks(way, link, positions);
    positions.back() = way.back();
    return link;
}

void placePoints(const RopeShape& shape, double distance, double length, std::vector<dvec3>& positions) {
    const int n = shape.segments;
    positions.front() = shape.start;
    positions.back() = shape.end;
    if (n > 1 && length > distance * (1.0 + 1e-9)) {
        if (!hangCatenary(shape, length / n, positions)) bendArc(shape, distance, length / n, positions);
    } else {
        for (int i = 1; i < n; ++i)
            positions[i] = shape.start + (shape.end - shape.start) * (static_cast<double>(i) / n);
    }
}

// Lays a level ring around the middle between start and end, or an upright ring if one lies above the other. Returns
// the length of a link.
double layRing(const RopeShape& shape, std::vector<dvec3>& positions) {
    const dvec3 arm = 0.5 * (shape.end - shape.start), centre = shape.start + arm;
    const double radius = glm::length(arm);
    const dvec3 level = glm::cross(arm, dvec3(0, 1, 0));
    const dvec3 side = radius * (glm::length(level) > 1e-9 * radius ? glm::normalize(level) : dvec3(1, 0, 0));
    const auto count = static_cast<double>(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const double angle = 2.0 * core::pi * static_cast<double>(i) / count;
        positions[i] = centre - core::cosine(angle) * arm + core::sine(angle) * side;
    }
    return 2.0 * radius * core::sine(core::pi / count);
}

// Lays a ring through its places. Returns the length of a link.
double layLoop(const RopeShape& shape, std::vector<dvec3>& positions) {
    std::vector<dvec3> round(positions.size() + 1);
    const double link = layAlong(smoothWay(shape), round);
    std::copy(round.begin(), round.end() - 1, positions.begin());
    return link;
}

void addFreeformBending(Model& model, const RopeShape& shape) {
    if (!(shape.rigidity > 0.0)) return;
    model.freeform = {.rigidity = {.along = shape.rigidity},
                      .rest = model.positions,
                      .warp = {},
                      .isClosed = shape.isClosed,
                      .isCurved = shape.isCurvedAtRest,
                      .dampingTime = shape.dampingTime};
}

// As a rope with ends, except that every point has two neighbours.
Model buildRing(const RopeShape& shape) {
    TAUT_EXPECTS(shape.segments >= 3 && shape.mass > 0.0);
    const int n = shape.segments;
    if (shape.start == shape.end && shape.through.empty())
        throw core::Error(core::ErrorKind::badContent, "a closed rope needs two distinct ends");
    Model model;
    detail::addRestingPoints(model, n, shape.dragRate);
    const double link = shape.through.empty() ? layRing(shape, model.positions) : layLoop(shape, model.positions);
    int far = 0;
    for (int i = 0; i < n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        model.positions[at] = detail::withoutNegativeZero(model.positions[at]);
        model.masses[at] = shape.mass / n;
        model.uv[at] = {link * i, 0.0};
        const auto distance = [&](int point) { return glm::length(model.positions[point] - shape.end); };
        if (distance(i) < distance(far)) far = i;
    }
    // Springs to the next point and to the one after it.
    for (int i = 0; i < n; ++i)
        model.springs.push_back(
            {i, (i + 1) % n, shape.stretch / link, link, shape.dampingTime, SpringKind::structural});
    if (shape.bend > 0.0 && n > 4)
        for (int i = 0; i < n; ++i)
            model.springs.push_back(
                {i, (i + 2) % n, shape.bend / (2.0 * link), 2.0 * link, shape.dampingTime, SpringKind::bend});
    addFreeformBending(model, shape);
    model.groups["start"] = {0};
    model.groups["end"] = {far};
    model.groups["ends"] = {0, far};
    return model;
}

}  // namespace

// k = EA/ℓ: a link of length ℓ under the tension EA ε grows by ε ℓ. A span-2 spring is a link of length 2ℓ.
Model buildRope(const RopeShape& shape) {
    if (shape.isClosed) return buildRing(shape);
    TAUT_EXPECTS(shape.segments >= 1 && shape.mass > 0.0 && shape.length >= 0.0);
    const int n = shape.segments;
    const double distance = glm::length(shape.end - shape.start);
    const double length = shape.length > 0.0 ? shape.length : distance;
    if (!(length > 0.0) && shape.through.empty())
        throw core::Error(core::ErrorKind::badContent, "a rope needs a length or two distinct ends");
    double link = length / n;

    Model model;
    // Points along a line, a catenary or an arc, or along the way through the given places.
    detail::addRestingPoints(model, n + 1, shape.dragRate);
    if (shape.through.empty())
        placePoints(shape, distance, length, model.positions);
    else
        link = layAlong(smoothWay(shape), model.positions);
    for (dvec3& p : model.positions) p = detail::withoutNegativeZero(p);
    for (int i = 0; i <= n; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const bool isEnd = i == 0 || i == n;
        model.masses[at] =
            shape.lumping == Lumping::uniform ? shape.mass / (n + 1) : shape.mass / n * (isEnd ? 0.5 : 1.0);
        model.uv[at] = {link * i, 0.0};
    }

    // Links, then bending by springs over two links or by a rigidity.
    for (int i = 0; i < n; ++i)
        model.springs.push_back({i, i + 1, shape.stretch / link, link, shape.dampingTime, SpringKind::structural});
    if (shape.bend > 0.0)
        for (int i = 0; i + 2 <= n; ++i)
            model.springs.push_back(
                {i, i + 2, shape.bend / (2.0 * link), 2.0 * link, shape.dampingTime, SpringKind::bend});

    if (shape.isCurvedAtRest) {
        addFreeformBending(model, shape);
    } else if (shape.rigidity > 0.0) {
        model.bending = lineBending(n + 1, shape.rigidity, link);
        model.bending.dampingTime = shape.dampingTime;
    }

    model.groups["start"] = {0};
    model.groups["end"] = {n};
    model.groups["ends"] = {0, n};
    return model;
}

std::vector<std::string> ropeGroups() {
    return {"start", "end", "ends"};
}

}  // namespace taut::mechanics
