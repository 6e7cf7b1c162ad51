#include "taut/world/private/surface_gap.h"

#include <algorithm>
#include <limits>
#include <set>

#include "taut/contact/crossings.h"
#include "taut/contact/contact_group.h"
#include "taut/bodies/body.h"
#include "taut/island/private/island.h"
#include "taut/world/private/contact_stage.h"

namespace taut::world {
namespace {

// The surface with the body's model numbers plus `offset`, whatever the island numbers.
contact::ContactSurface loneSurface(const Body& body, int offset, int bond) {
    contact::ContactSurface surface = surfaceOf(body, 0, bond);
    std::vector<int> own;
    for (std::size_t i = 0; i < body.pointOf.size(); ++i) {
        own.resize(std::max(own.size(), static_cast<std::size_t>(body.pointOf[i]) + 1));
        own[static_cast<std::size_t>(body.pointOf[i])] = offset + static_cast<int>(i);
    }
    const auto renumber = [&](int& i) { i = own[static_cast<std::size_t>(i)]; };
    for (int& i : surface.points) renumber(i);
    for (std::array<int, 3>& triangle : surface.triangles)
        for (int& i : triangle) renumber(i);
    for (std::array<int, 2>& line : surface.lines)
        for (int& i : line) renumber(i);
    surface.revolution = {};
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

SurfaceGap::SurfaceGap(const Selection& first, const Selection& second) : generation_(first.generation) {
    TAUT_EXPECTS(first.generation == second.generation);
    const auto add = [&](const Selection& selection, std::vector<bool>& isOf) {
        for (const Selection::Part& part : selection.parts) {
            auto at = std::find(bodies_.begin(), bodies_.end(), part.body);
            if (at == bodies_.end()) {
                at = bodies_.insert(bodies_.end(), part.body);
                isFirst_.push_back(false);
                isSecond_.push_back(false);
            }
            isOf[static_cast<std::size_t>(at - bodies_.begin())] = true;
        }
    };
    add(first, isFirst_);
    add(second, isSecond_);
    build();
}

void SurfaceGap::build() {
    std::vector<contact::ContactSurface> surfaces;
    std::vector<glm::dvec3> rest;
    for (const Body* body : bodies_) {
        const int number = static_cast<int>(surfaces.size());
        surfaces.push_back(loneSurface(*body, static_cast<int>(rest.size()), number));
        const std::vector<glm::dvec3>& start = body->model.positions;
        rest.insert(rest.end(), start.begin(), start.end());
    }
    damage_.assign(bodies_.size(), 0);
    goneAround_ = goneAroundIn(bodies_);
    x_.resize(rest.size());
    elements_ = std::make_unique<contact::Elements>(std::move(surfaces), std::move(rest));
    patches_ = std::make_unique<contact::Bvh>(*elements_);
}

void SurfaceGap::look() {
    if (goneAroundIn(bodies_) != goneAround_) build();
    std::size_t offset = 0;
    bool isOther = false;
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        const Body& body = *bodies_[s];
        const int first = static_cast<int>(offset);
        for (int i : body.pointOf) x_[offset++] = body.island->position(i);
        if (damage_[s] == body.damage.edges().size()) continue;
        damage_[s] = body.damage.edges().size();
        isOther = true;
        elements_->setGone(
            static_cast<int>(s), [&](std::size_t triangle) { return body.damage.isTriangleGone(triangle); },
            [&](int a, int b) { return body.damage.isSevered(a - first, b - first); });
    }
    if (!isOther) return;
    elements_->refresh();
    patches_->takeBalls();
}

bool SurfaceGap::cross(const std::vector<bool>& first, const std::vector<bool>& second) {
    const auto isOf = [](const std::vector<bool>& side, int surface) {
        return side[static_cast<std::size_t>(surface)];
    };
    for (const contact::Crossing& crossing : contact::findCrossings(*elements_, *patches_, x_)) {
        const int edge = elements_->edges()[static_cast<std::size_t>(crossing.edge)].surface;
        const int triangle = elements_->triangles()[static_cast<std::size_t>(crossing.triangle)].surface;
        if ((isOf(first, edge) && isOf(second, triangle)) || (isOf(second, edge) && isOf(first, triangle))) return true;
    }
    return false;
}

// Expects sides without a common body.
double SurfaceGap::distance(const std::vector<bool>& first, const std::vector<bool>& second) {
    if (!any(first) || !any(second)) return std::numeric_limits<double>::infinity();
    if (cross(first, second)) return 0;
    return contact::distanceBetween(
        *elements_, *patches_, x_, [&](int s) { return first[static_cast<std::size_t>(s)]; },
        [&](int s) { return second[static_cast<std::size_t>(s)]; });
}

// Bodies on both sides are measured against the others, one at a time.
double SurfaceGap::least(std::vector<bool> first, const std::vector<bool>& second) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
        if (!first[s] || !second[s]) continue;
        first[s] = false;
        std::vector<bool> alone(bodies_.size(), false), others = second;
        alone[s] = true;
        others[s] = false;
        least = std::min(least, distance(alone, others));
    }
    return std::min(least, distance(first, second));
}

double SurfaceGap::measure() {
    look();
    return least(isFirst_, isSecond_);
}

// Compares the surfaces of one thickness with those of another.
bool SurfaceGap::areNear() {
    look();
    const auto thickness = [&](std::size_t s) { return elements_->surface(static_cast<int>(s)).thickness; };
    const auto thicknesses = [&](const std::vector<bool>& side) {
        std::set<double> all;
        for (std::size_t s = 0; s < bodies_.size(); ++s)
            if (side[s]) all.insert(thickness(s));
        return all;
    };
    const auto ofThickness = [&](std::vector<bool> side, double t) {
        for (std::size_t s = 0; s < bodies_.size(); ++s) side[s] = side[s] && thickness(s) == t;
        return side;
    };
    for (double a : thicknesses(isFirst_))
        for (double b : thicknesses(isSecond_))
            if (least(ofThickness(isFirst_, a), ofThickness(isSecond_, b)) <= contact::nearShare * (a + b)) return true;
    return false;
}

}  // namespace taut::world
