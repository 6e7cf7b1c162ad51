#include "taut/collision/colliders.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "taut/collision/private/convex_form.h"
#include "taut/collision/private/cull.h"
#include "taut/collision/private/impl.h"
#include "taut/core/error.h"

namespace taut::collision {
namespace {

// What a way meets, as from its end: a plane, and the place on the form where it is met.
struct Met {
    Nearest plane;
    dvec3 place;  // [m]
};

// What a path meets whose end is nearest to `near`: a convex form with its thickness, if it begins farther off; else,
// with none, what it leads through. Of all others what is nearest to its end; none if that is no nearer than `reach`.
std::optional<Met> metBy(const Solid& solid, Path path, const Nearest& near, double reach) {
    const dvec3 way = path.to - path.from;
    const double length = std::sqrt(glm::dot(way, way));
    const bool endsNear = near.distance < path.thickness;
    // A convex form lies behind the plane through the place nearest to the end.
    const bool mayMeet = endsNear ? near.distance + length > path.thickness
                                  : near.distance - glm::dot(near.normal, way) < path.thickness;
    Nearest start{};
    if (solid.convex && mayMeet) start = solid.form->nearest(path.from);
    HalfSpace touch{};
    bool hasMet = false, hasCrossed = false;
    if (start.distance > path.thickness) {
        hasMet = reachConvex(*solid.form, path, start, path.thickness, touch);
    } else if (near.distance < length) {
        path.thickness = solid.convex ? 0.0 : 8.0 * path.skin;
        hasMet = solid.form->sweep(path, touch, hasCrossed);
    }
    if (hasMet && touch.normal != near.normal) {
        const double distance = glm::dot(touch.normal, path.to) - touch.offset, closing = -glm::dot(touch.normal, way);
        const double past = closing > 0 ? std::clamp(-distance / closing, 0.0, 1.0) : 0.0;  // share of the way
        return Met{{distance + path.thickness, touch.normal}, path.to - past * way - path.thickness * touch.normal};
    }
    if (!(near.distance < reach)) return std::nullopt;
    return Met{near, path.to - near.distance * near.normal};
}

// What a solid's motion of a step makes of a place, so many times.
Frame motionOf(const Solid& solid, int times) {
    const glm::dmat3 turn = solid.to.rotation * glm::transpose(solid.from.rotation);
    const Frame once{turn, solid.to.position - turn * solid.from.position, true};
    Frame all;
    for (int i = 0; i < times; ++i) all = once.of(all);
    return all;
}

}  // namespace

Colliders::Colliders() : impl_(std::make_unique<Impl>()) {}
Colliders::~Colliders() = default;
Colliders::Colliders(Colliders&&) noexcept = default;
Colliders& Colliders::operator=(Colliders&&) noexcept = default;

int Colliders::add(const Shape& shape, const Material& material, const Pose& pose) {
    const auto fail = [](const std::string& what) {
        throw core::Error(core::ErrorKind::badContent, "collider material: " + what);
    };
    if (!(material.friction >= 0.0) || !isFinite(material.friction)) fail("the friction has to be zero or more");
    if (!(material.restitution >= 0.0 && material.restitution <= 1.0)) fail("the restitution has to be from 0 to 1");

    std::vector<Solid> made;
    appendSolids(shape, Frame{}, made);
    for (Solid& solid : made) place(solid, pose, pose);
    const int number = size();
    for (Solid& solid : made) {
        solid.collider = number;
        solid.material = material;
        impl_->solids.push_back(std::move(solid));
    }
    impl_->firstSolid.push_back(impl_->solids.size());
    return number;
}

Colliders Colliders::clone() const {
    Colliders copy;
    *copy.impl_ = *impl_;
    return copy;
}

bool Colliders::bounces() const {
    return std::any_of(
        impl_->solids.begin(), impl_->solids.end(),
        [](const Solid& solid) { return solid.material.restitution > 0.0; });
}
int Colliders::size() const {
    return static_cast<int>(impl_->firstSolid.size()) - 1;
}

void Colliders::move(int collider, const Pose& from, const Pose& to) {
    TAUT_EXPECTS(collider >= 0 && collider < size());
    const std::size_t first = impl_->firstSolid[static_cast<std::size_t>(collider)];
    const std::size_t last = impl_->firstSolid[static_cast<std::size_t>(collider) + 1];
    double travel = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        place(impl_->solids[i], from, to);
        const double way = travelOf(impl_->solids[i]);
        if (way > travel) travel = way;
    }
    for (std::size_t i = first; i < last; ++i) impl_->solids[i].travel = travel;
}

bool Colliders::isNear(int collider, const core::Aabb& box) const {
    TAUT_EXPECTS(collider >= 0 && collider < size());
    const std::size_t first = impl_->firstSolid[static_cast<std::size_t>(collider)];
    const std::size_t last = impl_->firstSolid[static_cast<std::size_t>(collider) + 1];
    return std::any_of(impl_->solids.data() + first, impl_->solids.data() + last,
                       [&](const Solid& solid) { return !solid.bounded || solid.bounds.overlaps(box, 0.0); });
}

double Colliders::distance(const glm::dvec3& position) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Solid& solid : impl_->solids) {
        const dvec3 local = solid.to.toLocal(position);
        const double d = solid.form->nearest(local).distance;
        if (d < least) least = d;
    }
    return least;
}

Colliders::Near Colliders::nearest(const glm::dvec3& position, double reach) const {
    Near near{std::numeric_limits<double>::infinity(), dvec3(0.0)};
    for (const Solid& solid : impl_->solids) {
        if (solid.bounded && !solid.bounds.overlaps({position, position}, reach)) continue;
        const Nearest found = solid.form->nearest(solid.to.toLocal(position));
        if (found.distance < std::min(reach, near.distance))
            near = {found.distance, solid.to.directionToWorld(found.normal)};
    }
    return near;
}

void Colliders::findNear(std::span<const Way> ways, double thickness, double seconds, double h,
                         std::vector<Surface>& found) const {
    const auto boxOf = [](const Way& way, const dvec3& from) {
        core::Aabb box{way.to, way.to};
        box.add(from);
        box.grow(way.reach);
        return box;
    };
    core::Aabb all;
    for (const Way& way : ways) all.add(boxOf(way, way.from));
    for (const Solid& solid : impl_->solids) {
        const bool isStill = solid.still || hasJumped(solid, h);
        if (solid.bounded && isStill && !solid.bounds.overlaps(all, 0.0)) continue;
        const Frame moved = isStill ? Frame{} : motionOf(solid, static_cast<int>(std::lround(seconds / h)));
        for (std::size_t k = 0; k < ways.size(); ++k) {
            const Way& way = ways[k];
            const dvec3 from = isStill ? way.from : moved.toWorld(way.from);
            if (solid.bounded && !solid.bounds.overlaps(boxOf(way, from), 0.0)) continue;
            const dvec3 local = solid.to.toLocal(way.to);
            const Nearest near = solid.form->nearest(local);
            if (!(near.distance < way.reach) && !(near.distance < thickness + glm::distance(from, way.to))) continue;
            const double skin = skinPerMetre<double> * (glm::dot(glm::abs(way.to), dvec3(1.0)) + thickness);
            const std::optional<Met> met =
                metBy(solid, {solid.to.toLocal(from), local, thickness, skin}, near, way.reach);
            if (!met) continue;
            const dvec3 velocity =
                isStill ? dvec3(0.0) : (solid.to.toWorld(met->place) - solid.from.toWorld(met->place)) / h;
            found.push_back({k, met->plane.distance, solid.to.directionToWorld(met->plane.normal), velocity,
                             solid.collider, solid.material});
        }
    }
}

Colliders::Inside Colliders::inside(const glm::dvec3& position) const {
    Inside deepest;
    for (const Solid& solid : impl_->solids) {
        if (solid.bounded && !solid.bounds.contains(position)) continue;
        const double depth = -solid.form->nearest(solid.to.toLocal(position)).distance;
        if (depth > deepest.depth) deepest = {solid.collider, depth};
    }
    return deepest;
}

}  // namespace taut::collision
