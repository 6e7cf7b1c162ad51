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

// The contact of a path, as seen from its end: a plane, and its place on the form.
struct Met {
    Nearest plane;
    dvec3 place;  // [m]
};

// The contact of a path whose end is nearest to `near`: on a convex form with its thickness, if it begins farther off;
// else, without thickness, where it passes through. On all other forms the nearest place to its end; none beyond
// `reach`.
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

// The motion of a solid in a step, repeated so many times.
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
    if (!(material.turnFriction.rolling >= 0.0 && material.turnFriction.spin >= 0.0))
        fail("rolling and spin friction have to be at least 0");
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
    const std::size_t first = impl_->firstSolid[collider];
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
    const std::size_t first = impl_->firstSolid[collider];
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

namespace {

using Ways = Colliders::Ways;

const dvec3& at(std::span<const dvec3> places, int point) {
    return places[point];
}

double reachAt(const Ways& ways, int point) {
    return ways.ahead > 0 ? ways.reach + ways.ahead * glm::length(at(ways.velocities, point)) : ways.reach;
}

core::Aabb boxOf(const dvec3& from, const dvec3& to, double reach) {
    core::Aabb box{to, to};
    box.add(from);
    box.grow(reach);
    return box;
}

// Some that follow each other, taken together.
struct Block {
    std::span<const int> points;
    core::Aabb box;       // of their ways and reach
    dvec3 centre{0.0};    // [m] of their ends
    double radius = 0;    // [m] around it
    double furthest = 0;  // [m] a surface further from an end than this is not met
};

std::vector<Block> blocksOf(const Ways& ways, double thickness) {
    constexpr std::size_t inBlock = 32;
    std::vector<Block> blocks;
    for (std::size_t first = 0; first < ways.points.size(); first += inBlock) {
        Block& block = blocks.emplace_back();
        block.points = ways.points.subspan(first, std::min(inBlock, ways.points.size() - first));
        core::Aabb ends;
        double reach = 0, longest = 0;  // [m], [m²]
        for (const int i : block.points) {
            const dvec3 way = at(ways.to, i) - at(ways.from, i);
            ends.add(at(ways.to, i));
            reach = std::max(reach, reachAt(ways, i));
            longest = std::max(longest, glm::dot(way, way));
        }
        block.centre = ends.centre();
        block.radius = glm::length(ends.halfSize());
        block.furthest = std::max(reach, thickness + std::sqrt(longest));
        block.box = ends;
        block.box.grow(reach + std::sqrt(longest));
    }
    return blocks;
}

// Whether none of a block meets a solid that stands still. A form without bounds is convex, so distances from it grow
// no faster than the way from one place to another.
bool isPast(const Block& block, const Solid& solid) {
    constexpr double rounding = 1.0 + 1e-9;
    if (solid.bounded) return !solid.bounds.overlaps(block.box, 0.0);
    return solid.form->nearest(solid.to.toLocal(block.centre)).distance > rounding * (block.radius + block.furthest);
}

}  // namespace

void Colliders::findNear(const Ways& ways, double thickness, double seconds, double h,
                         std::vector<Surface>& found) const {
    const std::vector<Block> blocks = blocksOf(ways, thickness);
    for (const Solid& solid : impl_->solids) {
        const bool isStill = solid.still || hasJumped(solid, h);
        const Frame moved = isStill ? Frame{} : motionOf(solid, static_cast<int>(std::lround(seconds / h)));
        for (const Block& block : blocks) {
            if (isStill && isPast(block, solid)) continue;
            for (const int i : block.points) {
                const dvec3 &to = at(ways.to, i), from = isStill ? at(ways.from, i) : moved.toWorld(at(ways.from, i));
                const double reach = reachAt(ways, i);
                if (solid.bounded && !solid.bounds.overlaps(boxOf(from, to, reach), 0.0)) continue;
                const dvec3 local = solid.to.toLocal(to);
                const Nearest near = solid.form->nearest(local);
                if (!(near.distance < reach) && !(near.distance < thickness + glm::distance(from, to))) continue;
                const double skin = skinPerMetre<double> * (glm::dot(glm::abs(to), dvec3(1.0)) + thickness);
                const std::optional<Met> met =
                    metBy(solid, {solid.to.toLocal(from), local, thickness, skin}, near, reach);
                if (!met) continue;
                const dvec3 velocity =
                    isStill ? dvec3(0.0) : (solid.to.toWorld(met->place) - solid.from.toWorld(met->place)) / h;
                found.push_back({i, met->plane.distance, solid.to.directionToWorld(met->plane.normal), velocity,
                                 isStill ? dvec3(0.0) : spinBetween(solid.from, solid.to, h), solid.collider,
                                 solid.material});
            }
        }
    }
}

Colliders::Inside Colliders::inside(const glm::dvec3& centre, double radius) const {
    Inside deepest;
    for (const Solid& solid : impl_->solids) {
        if (solid.bounded && !solid.bounds.overlaps({centre, centre}, radius)) continue;
        const double depth = radius - solid.form->nearest(solid.to.toLocal(centre)).distance;
        if (depth > deepest.depth) deepest = {solid.collider, depth};
    }
    return deepest;
}

}  // namespace taut::collision
