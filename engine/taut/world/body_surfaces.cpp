#include "taut/world/private/body_surfaces.h"

#include <algorithm>
#include <limits>
#include <set>

#include "taut/bodies/private/carried_surface.h"
#include "taut/bodies/private/rigid_marks.h"
#include "taut/body/body.h"
#include "taut/contact/contact_group.h"
#include "taut/contact/crossings.h"
#include "taut/island/private/island.h"
#include "taut/world/private/contact_stage.h"

namespace taut::world {
namespace {

// The surface with the body's model numbers plus `offset`, in place of those of the island.
contact::ContactSurface loneSurface(const Body& body, const mechanics::RigidPart& part, int offset, int bond) {
    contact::ContactSurface surface = surfaceOf(body, part, 0, bond);
    std::vector<int> own;
    for (std::size_t i = 0; i < body.pointOf.size(); ++i) {
        own.resize(std::max(own.size(), static_cast<std::size_t>(body.pointOf[i]) + 1));
        own[body.pointOf[i]] = offset + static_cast<int>(i);
    }
    const auto renumber = [&](int& i) { i = own[i]; };
    for (int& i : surface.points) renumber(i);
    for (std::array<int, 3>& triangle : surface.triangles)
        for (int& i : triangle) renumber(i);
    for (std::array<int, 2>& line : surface.lines)
        for (int& i : line) renumber(i);
    surface.isConvex = false;
    surface.meetsItself = false;
    surface.meetsOthers = true;
    return surface;
}

bool any(const std::vector<bool>& flags) {
    return std::find(flags.begin(), flags.end(), true) != flags.end();
}

std::size_t goneAroundIn(std::span<const Body* const> bodies) {
    std::size_t gone = 0;
    for (const Body* body : bodies) gone += body->damage.goneAround();
    return gone;
}

}  // namespace

BodySurfaces::BodySurfaces(const Selection& first, const Selection& second) : generation_(first.generation) {
    TAUT_EXPECTS(first.generation == second.generation);
    const auto add = [&](const Selection& selection, std::vector<bool>& isOf) {
        for (const Selection::Part& part : selection.parts) {
            const std::size_t before = bodies_.size();
            if (std::find(bodies_.begin(), bodies_.end(), part.body) == bodies_.end())
                for (const mechanics::RigidPart& surface : surfacesOf(*part.body)) {
                    const std::vector<RigidPiece>& pieces = part.body->pieces;
                    const std::size_t number = bodies_.size() - before;
                    pieces_.push_back(number < pieces.size() ? pieces[number] : RigidPiece{});
                    bodies_.push_back(part.body);
                    parts_.push_back(surface);
                    isFirst_.push_back(false);
                    isSecond_.push_back(false);
                }
            for (std::size_t s = 0; s < bodies_.size(); ++s)
                if (bodies_[s] == part.body) isOf[s] = true;
        }
    };
    add(first, isFirst_);
    add(second, isSecond_);
    build();
}

void BodySurfaces::build() {
    std::vector<contact::ContactSurface> surfaces;
    std::vector<glm::dvec3> rest;
    first_.clear();
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const bool isNext = s > 0 && bodies_[s] == bodies_[s - 1];
        first_.push_back(isNext ? first_.back() : static_cast<int>(rest.size()));
        surfaces.push_back(loneSurface(*bodies_[s], parts_[s], first_[s], static_cast<int>(s)));
        const std::vector<glm::dvec3>& start = bodies_[s]->model.positions;
        if (!isNext) rest.insert(rest.end(), start.begin(), start.end());
    }
    const int firstCarried = static_cast<int>(rest.size());
    std::vector<contact::CarriedPoint> carried;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const auto numberOf = [&](int i) { return first_[s] + i; };
        carry(carriedSurface(*bodies_[s]), numberOf, surfaces[s], rest, carried);
    }
    carried_ = {firstCarried, std::move(carried)};
    damage_.assign(bodies_.size(), 0);
    goneAround_ = goneAroundIn(bodies_);
    x_.resize(rest.size());
    elements_ = std::make_unique<contact::Elements>(std::move(surfaces), std::move(rest));
    patches_ = std::make_unique<contact::Bvh>(*elements_);
}

void BodySurfaces::look() {
    if (goneAroundIn(bodies_) != goneAround_) build();
    bool isOther = false;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Body& body = *bodies_[s];
        const int first = first_[s];
        for (std::size_t i = 0; i < body.pointOf.size(); ++i)
            x_[static_cast<std::size_t>(first) + i] = body.island->position(body.pointOf[i]);
        const std::vector<int>& points = elements_->surface(static_cast<int>(s)).points;
        const bool isCarried = !points.empty() && carried_.has(points.front());  // until torn, and built anew
        if (isCarried || damage_[s] == body.damage.edges().size()) continue;
        damage_[s] = body.damage.edges().size();
        isOther = true;
        elements_->setGone(
            static_cast<int>(s), [&](std::size_t triangle) { return body.damage.isTriangleGone(triangle); },
            [&](int a, int b) { return body.damage.isSevered(a - first, b - first); });
    }
    for (int i = carried_.first(); i < carried_.end(); ++i) x_[i] = carried_.valueAt(i, x_);
    if (!isOther) return;
    elements_->refresh();
    patches_->refresh();
}

bool BodySurfaces::cross(const std::vector<bool>& first, const std::vector<bool>& second) {
    const auto isOf = [](const std::vector<bool>& side, int surface) { return side[surface]; };
    for (const contact::Crossing& crossing : contact::findCrossings(*elements_, *patches_, x_)) {
        const int edge = elements_->edges()[crossing.edge].surface;
        const int triangle = elements_->triangles()[crossing.triangle].surface;
        if ((isOf(first, edge) && isOf(second, triangle)) || (isOf(second, edge) && isOf(first, triangle))) return true;
    }
    return false;
}

// Expects sides without a common body.
double BodySurfaces::distance(const std::vector<bool>& first, const std::vector<bool>& second) {
    if (!any(first) || !any(second)) return std::numeric_limits<double>::infinity();
    if (cross(first, second)) return 0;
    return contact::distanceBetween(
        *elements_, *patches_, x_, [&](int s) { return first[s]; }, [&](int s) { return second[s]; });
}

// Bodies on both sides are measured against the others, one at a time.
double BodySurfaces::least(std::vector<bool> first, const std::vector<bool>& second) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        if (!first[s] || !second[s]) continue;
        std::vector<bool> alone(bodies_.size(), false), others = second;
        for (std::size_t own = 0; own < bodies_.size(); ++own)
            if (bodies_[own] == bodies_[s]) {
                alone[own] = first[own];
                first[own] = others[own] = false;
            }
        least = std::min(least, distance(alone, others));
    }
    return std::min(least, distance(first, second));
}

template <class Radius, class Each>
void BodySurfaces::forRadii(const Radius& radius, const Each& each) {
    const auto radii = [&](const std::vector<bool>& side) {
        std::set<double> all;
        for (std::size_t s = 0; s < bodies_.size(); ++s)
            if (side[s]) all.insert(radius(s));
        return all;
    };
    const auto ofRadius = [&](std::vector<bool> side, double r) {
        for (std::size_t s = 0; s < bodies_.size(); ++s) side[s] = side[s] && radius(s) == r;
        return side;
    };
    for (double a : radii(isFirst_))
        for (double b : radii(isSecond_)) each(a, b, least(ofRadius(isFirst_, a), ofRadius(isSecond_, b)));
}

double BodySurfaces::gap() {
    look();
    double gap = std::numeric_limits<double>::infinity();
    forRadii([&](std::size_t s) { return parts_[s].rounding; },
             [&](double a, double b, double least) { gap = std::min(gap, std::max(0.0, least - a - b)); });
    return gap;
}

bool BodySurfaces::areNear() {
    look();
    bool areNear = false;
    forRadii([&](std::size_t s) { return elements_->surface(static_cast<int>(s)).thickness; },
             [&](double a, double b, double least) { areNear = areNear || least <= contact::nearShare * (a + b); });
    return areNear;
}

// up: 1 or -1.
BodySurfaces::Place BodySurfaces::furthest(double up) {
    look();
    Place furthest{nullptr, {}};
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Body& body = *bodies_[s];
        const auto compare = [&](const glm::dvec3& x) {
            const glm::dvec3 place = x + glm::dvec3(0.0, up * parts_[s].rounding, 0.0);
            if (furthest.body == nullptr || !(up * place.y <= up * furthest.x.y)) furthest = {&body, place};
        };
        if (const collision::Convex* shape = pieces_[s].shape.get(); parts_[s].sag > 0) {
            const RigidMarks marks = marksOf(body);
            std::array<glm::dvec3, 3> now;
            for (std::size_t k = 0; k < 3; ++k) now[k] = x_[first_[s] + marks.points[k]];
            const collision::Frame at = marks.motionTo(now).of(pieces_[s].at);
            compare(at.toWorld(shape->support(glm::dvec3(0.0, up, 0.0) * at.rotation)));
        } else {
            for (const int i : elements_->surface(static_cast<int>(s)).points) compare(x_[i]);
        }
    }
    return furthest;
}

}  // namespace taut::world
