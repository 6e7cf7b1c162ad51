#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "taut/collision/convex.h"
#include "taut/collision/private/bullet_convex.h"

namespace taut::collision {
namespace {

constexpr double leaning = 0.2;    // sine of the angle to the normal's plane up to which a face or an edge supports
constexpr double oneDepth = 1e-6;  // of the size: difference between two results for one distance
constexpr double nudge = 1e-3;     // of the roundings, by which cores are moved apart whose distance is 0

struct Posed {
    const Convex& shape;
    const Frame& at;
    dvec3 directionToLocal(const dvec3& d) const { return at.turned ? d * at.rotation : d; }
    dvec3 support(const dvec3& direction) const { return at.toWorld(shape.support(directionToLocal(direction))); }
    dvec3 middle() const { return at.toWorld(shape.bounds()->centre()); }
    SupportingFace faceTowards(const dvec3& direction) const {
        SupportingFace face = shape.faceTowards(directionToLocal(direction));
        for (dvec3& corner : face.corners()) corner = at.toWorld(corner);
        return face;
    }
    btTransform transform(const dvec3& origin, const dvec3& shift) const {
        const glm::dmat3& r = at.rotation;
        return btTransform(btMatrix3x3(r[0].x, r[1].x, r[2].x, r[0].y, r[1].y, r[2].y, r[0].z, r[1].z, r[2].z),
                           toBullet(at.toWorld(shape.offset()) + shift - origin));
    }
};

// Whether the boxes around both are further apart than `reach` [m] along an axis of one of them. Of 1000 boxes in a
// heap, 3900 pairs are near each other, 2100 are left here, and 2000 touch. Half of their 2.7 ms is Bullet's search, a
// seventh the broad phase. btBoxBoxDetector would take half as long as the search, which is 1 % of a tick. It has no
// places for boxes that are apart; of boxes that are grown to meet, its gaps at corners are below the truth.
bool areApart(const Posed& a, const Posed& b, double reach) {
    const dvec3 way = b.middle() - a.middle(), halfA = a.shape.bounds()->halfSize(),
                halfB = b.shape.bounds()->halfSize();
    const glm::dmat3 turn = glm::transpose(a.at.rotation) * b.at.rotation;
    const glm::dmat3 size(glm::abs(turn[0]), glm::abs(turn[1]), glm::abs(turn[2]));
    const dvec3 gap = glm::max(glm::abs(way * a.at.rotation) - halfA - size * halfB,
                               glm::abs(way * b.at.rotation) - halfB - halfA * size);
    return glm::max(gap.x, glm::max(gap.y, gap.z)) > reach;
}

// Where two cores are nearest.
struct Nearby {
    dvec3 normal, onB;  // unit, from B to A; [m] on the core of B
    double distance;    // [m] of the cores
};

std::optional<Nearby> ask(const Posed& a, const Posed& b, double reach, const dvec3& shiftOfA) {
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(a.shape.bullet(), b.shape.bullet(), &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    const dvec3 origin = b.at.position;
    input.m_transformA = a.transform(origin, shiftOfA);
    input.m_transformB = b.transform(origin, dvec3(0.0));
    const double far = Convex::unit * (reach + a.shape.rounding() + b.shape.rounding());
    input.m_maximumDistanceSquared = far * far;
    btPointCollector found;
    detector.getClosestPoints(input, found, nullptr);
    if (!found.m_hasResult) return std::nullopt;
    const btVector3& n = found.m_normalOnBInWorld;
    const dvec3 normal(n.x(), n.y(), n.z());
    return Nearby{normal, origin + fromBullet(found.m_pointInWorld) - b.shape.rounding() * normal,
                  found.m_distance / Convex::unit + a.shape.rounding() + b.shape.rounding()};
}

// How far the cores are apart along a direction: their distance, if it is that of the nearest places.
double apartAlong(const Posed& a, const Posed& b, const dvec3& normal) {
    return glm::dot(normal, a.support(-normal) - b.support(normal));
}

// Cores whose distance is 0 have no direction from one another. These are asked again a little apart.
std::optional<Nearby> nearestOf(const Posed& a, const Posed& b, double reach) {
    std::optional<Nearby> found = ask(a, b, reach, dvec3(0.0));
    const dvec3 size = b.shape.bounds()->high - b.shape.bounds()->low;
    const double tolerance = oneDepth * (size.x + size.y + size.z);
    if (!found || std::abs(apartAlong(a, b, found->normal) - found->distance) <= tolerance) return found;
    const dvec3 way = a.middle() - b.middle();
    const double length = std::sqrt(glm::dot(way, way));
    const dvec3 shift =
        nudge * (a.shape.rounding() + b.shape.rounding()) * (length > 0.0 ? way / length : dvec3(0.0, 1.0, 0.0));
    found = ask(a, b, reach, shift);
    if (found) found->distance = apartAlong(a, b, found->normal);
    return found;
}

dvec3 areaOf(const SupportingFace& face) {
    dvec3 sum(0.0);
    for (int i = 1; i + 1 < face.count(); ++i) sum += glm::cross(face[i] - face[0], face[i + 1] - face[0]);
    return sum;
}

// The unit normal, out of the face; zero for an edge or a corner.
dvec3 normalOf(const SupportingFace& face) {
    const dvec3 area = areaOf(face);
    const double size = std::sqrt(glm::dot(area, area));
    return size > 0.0 ? area / size : dvec3(0.0);
}

// Keeps the part of a face or an edge in the half-space direction · x <= limit.
void clip(SupportingFace& face, const dvec3& direction, double limit) {
    SupportingFace left;
    const bool isEdge = face.count() == 2;
    for (int i = 0; i < (isEdge ? 1 : face.count()); ++i) {
        const dvec3 &from = face[i], &to = face[(i + 1) % face.count()];
        const double start = glm::dot(direction, from) - limit, end = glm::dot(direction, to) - limit;
        if (start <= 0.0) left.add(from);
        if ((start < 0.0 && end > 0.0) || (start > 0.0 && end < 0.0))
            left.add(from + (start / (start - end)) * (to - from));
        if (isEdge && end <= 0.0) left.add(to);
    }
    face = left;
}

using Places = std::vector<Manifold::Place>;

// The deepest of many places, and the ones that span the largest area with it.
void keepFour(Places& places, const dvec3& normal) {
    if (places.size() <= Manifold::most) return;
    std::array<Manifold::Place, Manifold::most> kept;
    const auto take = [&](std::size_t k, const auto& worth) {
        std::size_t best = 0;
        double most = worth(places[0]);
        for (std::size_t i = 1; i < places.size(); ++i) {
            constexpr double same = 1e-9;  // of two that are worth the same, the first
            const double own = worth(places[i]);
            if (!(own > most + same * std::abs(most))) continue;
            best = i;
            most = own;
        }
        kept[k] = places[best];
        places.erase(places.begin() + static_cast<std::ptrdiff_t>(best));
    };
    take(
        0, [](const Manifold::Place& place) { return -place.gap; });
    const auto from = [&](const Manifold::Place& place) { return place.onB - kept[0].onB; };
    take(1, [&](const Manifold::Place& place) { return glm::dot(from(place), from(place)); });
    const dvec3 across = glm::cross(from(kept[1]), normal);
    take(
        2, [&](const Manifold::Place& place) { return glm::dot(across, from(place)); });
    take(3, [&](const Manifold::Place& place) { return -glm::dot(across, from(place)); });
    places.assign(kept.begin(), kept.end());
}

// Corners of one face over the other face, the reference.
void clipFaces(const SupportingFace& reference, SupportingFace incident, const dvec3& face, const dvec3& up, bool isOfA,
               Places& places) {
    for (int i = 0; i < reference.count() && incident.count() > 0; ++i) {
        const dvec3 out = glm::cross(reference[(i + 1) % reference.count()] - reference[i], face);
        clip(incident, out, glm::dot(out, reference[i]));
    }
    for (const dvec3& corner : incident.corners()) {
        const double height = glm::dot(face, corner - reference[0]) / glm::dot(face, up);
        const dvec3 foot = corner - height * up;
        places.push_back({isOfA ? foot : corner, isOfA ? corner : foot, height});
    }
}

// The edge of a flat face that reaches furthest in a direction; other faces stay as they are.
SupportingFace edgeTowards(const SupportingFace& face, const dvec3& direction) {
    if (face.count() <= 2 || face.isRim) return face;
    const auto reach = [&](int i) { return glm::dot(direction, face[i]); };
    int best = 0;
    for (int i = 1; i < face.count(); ++i)
        if (reach(i) > reach(best)) best = i;
    const int before = (best + face.count() - 1) % face.count(), after = (best + 1) % face.count();
    SupportingFace edge;
    edge.add(face[best]);
    edge.add(face[reach(before) > reach(after) ? before : after]);
    return edge;
}

// Two edges that are nearly parallel and lie across the normal: both ends of their common part.
void clipEdges(const SupportingFace& a, const SupportingFace& b, const dvec3& normal, Places& places) {
    if (a.count() != 2 || b.count() != 2) return;
    const dvec3 ofA = glm::normalize(a[1] - a[0]), ofB = glm::normalize(b[1] - b[0]);
    const dvec3 turned = glm::cross(ofA, ofB);
    if (std::abs(glm::dot(ofA, normal)) > leaning || glm::dot(turned, turned) > leaning * leaning) return;
    SupportingFace common = a;
    clip(common, ofB, glm::dot(ofB, b[1]));
    clip(common, -ofB, -glm::dot(ofB, b[0]));
    for (const dvec3& onA : common.corners()) {
        const dvec3 onB = b[0] + glm::dot(ofB, onA - b[0]) * ofB;
        places.push_back({onA, onB, glm::dot(normal, onA - onB)});
    }
}

// Places of the cores -> places on the surfaces.
Manifold finish(Places& places, const dvec3& normal, double ofA, double ofB, double reach) {
    for (Manifold::Place& place : places)
        place = {place.onA - ofA * normal, place.onB + ofB * normal, place.gap - ofA - ofB};
    std::erase_if(places, [&](const Manifold::Place& place) { return !(place.gap < reach); });
    keepFour(places, normal);
    Manifold manifold;
    manifold.normal = normal;
    for (const Manifold::Place& place : places) manifold.of[manifold.count++] = place;
    return manifold;
}

Manifold onHalfSpace(const Posed& a, const Posed& plane, double reach) {
    const dvec3 up = plane.at.directionToWorld(plane.shape.up());
    thread_local Places places;
    places.clear();
    const SupportingFace face = a.faceTowards(-up);
    for (const dvec3& corner : face.corners()) {
        const double height = glm::dot(up, corner - plane.at.position);
        places.push_back({corner, corner - height * up, height});
    }
    return finish(places, up, a.shape.rounding(), 0.0, reach);
}

}  // namespace

Manifold manifoldOf(const Convex& shapeA, const Frame& atA, const Convex& shapeB, const Frame& atB, double reach) {
    const Posed a{shapeA, atA}, b{shapeB, atB};
    if (shapeB.isHalfSpace()) return shapeA.isHalfSpace() ? Manifold{} : onHalfSpace(a, b, reach);
    if (shapeA.isHalfSpace()) {
        Manifold manifold = onHalfSpace(b, a, reach);
        manifold.normal = -manifold.normal;
        for (int k = 0; k < manifold.count; ++k) {
            Manifold::Place& place = manifold.of[k];
            std::swap(place.onA, place.onB);
        }
        return manifold;
    }
    if (areApart(a, b, reach)) return {};
    const std::optional<Nearby> nearest = nearestOf(a, b, reach);
    if (!nearest) return {};
    const dvec3& normal = nearest->normal;
    const SupportingFace faceA = a.faceTowards(-normal), faceB = b.faceTowards(normal);
    thread_local Places places;
    places.clear();
    // A face that is more nearly across the normal is the reference.
    const dvec3 upA = normalOf(faceA), upB = normalOf(faceB);
    const double ofA = -glm::dot(upA, normal), ofB = glm::dot(upB, normal);
    const bool isA = ofA > ofB;
    if (faceA.count() > 1 && faceB.count() > 1) {
        if (std::max(ofA, ofB) > std::sqrt(1.0 - leaning * leaning))
            clipFaces(isA ? faceA : faceB, isA ? faceB : faceA, isA ? upA : upB, isA ? -normal : normal, isA, places);
        else
            clipEdges(edgeTowards(faceA, -normal), edgeTowards(faceB, normal), normal, places);
    }
    // The nearest place always counts.
    constexpr double same = 1e-6;
    const bool isThere = std::any_of(places.begin(), places.end(), [&](const Manifold::Place& place) {
        return place.gap <= nearest->distance + same * (reach + std::abs(nearest->distance));
    });
    if (!isThere) places.push_back({nearest->onB + nearest->distance * normal, nearest->onB, nearest->distance});
    return finish(places, normal, shapeA.rounding(), shapeB.rounding(), reach);
}

}  // namespace taut::collision
