#include "taut/world/private/collider_surfaces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "taut/core/error.h"
#include "taut/spec/private/motion.h"

namespace taut::world {
namespace {

constexpr double jumpSpeed = 100.0;  // [m/s] of any vertex; a collider that is faster jumps

struct Placing {
    glm::dmat3 rotation;
    dvec3 position;
    explicit Placing(const collision::Pose& pose) : position(pose.position) {
        const glm::dquat& q = pose.rotation;
        const double size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        rotation = glm::mat3_cast(glm::dquat(q.w / size, q.x / size, q.y / size, q.z / size));
    }
    dvec3 operator()(const dvec3& x) const { return rotation * x + position; }
};

contact::ContactSurface surfaceOf(const collision::Outline& outline, const collision::Material& material, int offset,
                                  int bond) {
    contact::ContactSurface surface;
    surface.isRigid = true;
    surface.meetsItself = surface.meetsOthers = false;
    surface.thickness = 0;
    surface.isConvex = outline.isConvex;
    surface.friction = material.friction;
    surface.turnFriction = material.turnFriction;
    surface.bond = bond;
    for (int corner : outline.corners) surface.points.push_back(offset + corner);
    for (const collision::Outline::Edge& edge : outline.edges) {
        surface.lines.push_back({offset + edge.a, offset + edge.b});
        const auto wing = [&](int vertex) { return vertex < 0 ? -1 : offset + vertex; };
        surface.wings.push_back({wing(edge.wingA), wing(edge.wingB)});
    }
    return surface;
}

contact::ContactSurface surfaceOf(const ColliderFigure& figure, const collision::Material& material, int offset,
                                  int bond) {
    contact::ContactSurface surface;
    surface.isDriven = true;
    surface.meetsItself = surface.meetsOthers = false;
    surface.thickness = 0;
    surface.friction = material.friction;
    surface.turnFriction = material.turnFriction;
    surface.bond = bond;
    for (int i = 0; i < static_cast<int>(figure.atRest().size()); ++i) surface.points.push_back(offset + i);
    surface.ranks.assign(figure.ranks().begin(), figure.ranks().end());
    for (const std::array<int, 3>& t : figure.triangles())
        surface.triangles.push_back({offset + t[0], offset + t[1], offset + t[2]});
    return surface;
}

}  // namespace

ColliderSurfaces::ColliderSurfaces(const std::vector<TouchedCollider>& colliders, double seconds,
                                   std::vector<contact::ContactSurface>& surfaces, std::vector<dvec3>& rest) {
    for (std::size_t c = 0; c < colliders.size(); ++c) {
        Collider own;
        own.collider = static_cast<int>(c);
        own.name = colliders[c].name;
        own.figure = colliders[c].figure;
        own.firstPoint = static_cast<int>(rest.size());
        own.firstSurface = static_cast<int>(surfaces.size());
        own.from = own.to = colliders[c].pose;
        // No other surface has this bond.
        const auto bond = [&] { return -1 - static_cast<int>(surfaces.size()); };
        if (own.figure != nullptr) {
            surfaces.push_back(surfaceOf(*own.figure, colliders[c].material, own.firstPoint, bond()));
            own.vertices.assign(own.figure->atRest().begin(), own.figure->atRest().end());
            rest.insert(rest.end(), own.vertices.begin(), own.vertices.end());
            setEnds(own, seconds);
        }
        const Placing place(colliders[c].pose);
        for (const collision::Outline& outline : colliders[c].outlines) {
            if (outline.vertices.empty()) continue;
            surfaces.push_back(surfaceOf(outline, colliders[c].material, static_cast<int>(rest.size()), bond()));
            for (const dvec3& vertex : outline.vertices) rest.push_back(place(vertex));
            own.vertices.insert(own.vertices.end(), outline.vertices.begin(), outline.vertices.end());
        }
        own.lastSurface = static_cast<int>(surfaces.size());
        if (!own.vertices.empty()) colliders_.push_back(std::move(own));
    }
}

bool ColliderSurfaces::hasFigures() const {
    return std::any_of(
        colliders_.begin(), colliders_.end(), [](const Collider& own) { return own.figure != nullptr; });
}

const std::string& ColliderSurfaces::nameOf(int surface) const {
    const auto owner = std::find_if(colliders_.begin(), colliders_.end(),
                                    [&](const Collider& own) { return surface < own.lastSurface; });
    TAUT_EXPECTS(owner != colliders_.end());
    return owner->name;
}

std::vector<int> ColliderSurfaces::surfacesOf(const std::string& collider) const {
    std::vector<int> all;
    for (const Collider& own : colliders_)
        for (int s = own.firstSurface; s < own.lastSurface && own.name == collider; ++s) all.push_back(s);
    return all;
}

// The end of a figure's tick becomes the start of the next.
void ColliderSurfaces::setEnds(Collider& own, double end) {
    own.xFrom.swap(own.xTo);
    own.xTo = own.figure->at(end, own.to).places();
    if (own.xFrom.empty()) own.xFrom = own.xTo;
    own.moves = own.xFrom != own.xTo;
}

bool ColliderSurfaces::move(std::span<const ColliderMotion> moving, double end, double tickSeconds,
                            contact::Elements& elements, std::span<dvec3> v) {
    bool hasJumped = false;
    for (Collider& own : colliders_) {
        own.hasMoved = std::exchange(own.moves, false);
        own.from = own.to;
        for (const ColliderMotion& motion : moving) {
            if (motion.collider != own.collider) continue;
            own.from = motion.from;
            own.to = motion.to;
            own.moves = true;
        }
        if (own.figure != nullptr) setEnds(own, end);
        for (int s = own.firstSurface; s < own.lastSurface; ++s) elements.setStill(s, !own.moves);
        if (!own.moves && !own.hasMoved) continue;
        const Placing from(own.from), to(own.to);
        const std::span<dvec3> velocities = v.subspan(own.firstPoint, own.vertices.size());
        double square = 0;
        for (std::size_t i = 0; i < velocities.size(); ++i) {
            velocities[i] =
                (own.figure != nullptr ? own.xTo[i] - own.xFrom[i] : to(own.vertices[i]) - from(own.vertices[i])) /
                tickSeconds;
            square = std::max(square, glm::dot(velocities[i], velocities[i]));
        }
        if (!(square > jumpSpeed * jumpSpeed)) continue;
        own.from = own.to;
        own.xFrom = own.xTo;
        std::fill(velocities.begin(), velocities.end(), dvec3(0.0));
        hasJumped = true;
    }
    return hasJumped;
}

void ColliderSurfaces::place(double share, std::span<dvec3> x) const {
    for (const Collider& own : colliders_) {
        if (!own.moves && !own.hasMoved) continue;
        const std::span<dvec3> places = x.subspan(own.firstPoint, own.vertices.size());
        const Placing place(between(own.from, own.to, share));
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = own.figure == nullptr ? place(own.vertices[i])
                        : share < 1           ? own.xFrom[i] + share * (own.xTo[i] - own.xFrom[i])
                                              : own.xTo[i];
    }
}

void ColliderSurfaces::placeAll(std::span<dvec3> x) const {
    for (const Collider& own : colliders_) {
        const std::span<dvec3> places = x.subspan(own.firstPoint, own.vertices.size());
        const Placing place(own.to);
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i] = own.figure == nullptr ? place(own.vertices[i]) : own.xTo[i];
    }
}

}  // namespace taut::world
