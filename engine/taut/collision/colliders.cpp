#include "taut/collision/colliders.h"

#include <algorithm>
#include <optional>
#include <string>

#include "taut/collision/private/impl.h"
#include "taut/core/error.h"

namespace taut::collision {
namespace {

// The plane, as from the end of a path, on which this comes as near as its thickness to a convex form. It starts
// farther off; none: it ends so too, and never comes near. Each step leads to the plane through the nearest place, so
// never too far.
std::optional<Nearest> meeting(const Form& form, const Path& path, Nearest near) {
    constexpr int mostSteps = 32;
    const dvec3 way = path.to - path.from;
    double share = 0;
    for (int i = 0; i < mostSteps && near.distance - path.thickness > nearEnough(path); ++i) {
        const double closing = -glm::dot(near.normal, way);
        if (!(closing > 0)) return std::nullopt;
        share += (near.distance - path.thickness) / closing;
        if (!(share < 1)) return std::nullopt;
        near = form.nearest(path.from + share * way);
    }
    return Nearest{near.distance + (1 - share) * glm::dot(near.normal, way), near.normal};
}

// Turns `near`, at the end of a path, to the plane on which the path met the form: with its thickness, if it began
// farther off, else with none, if it leads through. Returns whether it has met the form and does not end near.
bool turnToMeeting(const Solid& solid, Path path, Nearest& near) {
    const dvec3 way = path.to - path.from;
    const double length = std::sqrt(glm::dot(way, way));
    const bool endsNear = near.distance < path.thickness;
    if (solid.convex) {
        // It lies behind the plane through the place nearest to the end.
        if (!endsNear && near.distance - glm::dot(near.normal, way) >= path.thickness) return false;
        if (near.distance + length <= path.thickness) return false;
        if (const Nearest start = solid.form->nearest(path.from); start.distance > path.thickness) {
            const std::optional<Nearest> met = meeting(*solid.form, path, start);
            if (met && met->normal != near.normal) near = *met;
            return met && !endsNear;
        }
    }
    if (!(near.distance < length)) return false;
    path.thickness = 0;
    HalfSpace touch{};
    bool hasCrossed = false;
    if (!solid.form->sweep(path, touch, hasCrossed) || touch.normal == near.normal) return false;
    near = {glm::dot(touch.normal, path.to) - touch.offset, touch.normal};
    return true;
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

void Colliders::findNear(std::span<const Way> ways, double h, std::vector<Surface>& found) const {
    const auto boxOf = [](const Way& way, const dvec3& from) {
        core::Aabb box{way.to, way.to};
        box.add(from);
        box.grow(way.reach);
        return box;
    };
    core::Aabb all;
    for (const Way& way : ways) all.add(boxOf(way, way.from));
    for (const Solid& solid : impl_->solids) {
        if (solid.bounded && solid.still && !solid.bounds.overlaps(all, 0.0)) continue;
        const auto velocityAt = [&](const dvec3& p) {
            return solid.still ? dvec3(0.0) : (solid.to.toWorld(p) - solid.from.toWorld(p)) / h;
        };
        for (std::size_t k = 0; k < ways.size(); ++k) {
            const Way& way = ways[k];
            dvec3 from = way.from;
            if (!solid.still) from += way.seconds * velocityAt(solid.to.toLocal(from));
            if (solid.bounded && !solid.bounds.overlaps(boxOf(way, from), 0.0)) continue;
            const dvec3 local = solid.to.toLocal(way.to);
            Nearest near = solid.form->nearest(local);
            if (!(near.distance < way.reach) && !(near.distance < way.thickness + glm::distance(from, way.to)))
                continue;
            const bool hasMet = turnToMeeting(solid, {solid.to.toLocal(from), local, way.thickness, 0.0}, near);
            if (!hasMet && !(near.distance < way.reach)) continue;
            const dvec3 foot = local - near.distance * near.normal;
            found.push_back({k, near.distance, solid.to.directionToWorld(near.normal), velocityAt(foot), solid.collider,
                             solid.material});
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
