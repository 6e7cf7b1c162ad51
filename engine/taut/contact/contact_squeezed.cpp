// Points that driven surfaces close upon from two sides.
#include <algorithm>
#include <cmath>
#include <utility>

#include "taut/contact/contact_group.h"

namespace taut::contact {
namespace {

constexpr double oneSided = 0.5;        // share of impulses that does not cancel
constexpr double squeezedShare = 3e-4;  // of the thickness, by which soft pairs of squeezed points yield in a step

}  // namespace

// Driven surfaces that close upon a body from two sides leave it nowhere to go, and impulses against that would throw
// it out. Of squeezed points only the driven surface of the lowest rank presses on, if there are several; the others
// may go through. A point is squeezed where impulses press it from opposite sides and a driven surface closes faster
// than its softness explains. Returns whether any is, beyond those known.
bool ContactGroup::findSqueezed() {
    if (std::none_of(active_.begin(), active_.end(), [](const auto& pair) { return pair.softness > 0; })) return false;
    pressed_.resize(u_.size());
    std::vector<int> points;
    for (std::size_t p = 0; p < active_.size(); ++p) {
        const ContactConstraint& pair = active_[p];
        const double impulse = solver_.impulses()[p];
        if (!(impulse > 0)) continue;
        const bool isSoft = pair.softness > 0;
        const int rank = isSoft ? rankOf(pair) : 0;
        double inverse = 0;
        for (std::size_t k = 0; k < 4; ++k)
            inverse += pair.weights[k] * pair.weights[k] * block_.inverseMass[static_cast<std::size_t>(pair.points[k])];
        const bool yields = pair.softness * inverse * impulse * block_.h > squeezedShare * pair.thickness;
        for (std::size_t k = 0; k < 4; ++k) {
            Pressed& own = pressed_[static_cast<std::size_t>(pair.points[k])];
            if (own.size == 0) points.push_back(pair.points[k]);
            own.sum += (pair.weights[k] * impulse) * pair.normal;
            own.size += std::abs(pair.weights[k]) * impulse;
            own.yields = own.yields || yields;
            if (!isSoft) continue;
            own.lowest = std::min(own.lowest, rank);
            own.highest = std::max(own.highest, rank);
        }
    }
    bool isAny = false;
    for (int point : points) {
        const Pressed own = std::exchange(pressed_[static_cast<std::size_t>(point)], {});
        if (!own.yields || !(block_.inverseMass[static_cast<std::size_t>(point)] > 0)) continue;
        if (length(own.sum) >= oneSided * own.size) continue;
        const int kept = own.lowest < own.highest ? own.lowest : -1;
        const auto [known, isNew] = squeezed_.try_emplace(point, kept);
        isAny = isAny || isNew || kept < known->second;
        known->second = std::min(known->second, kept);
    }
    return isAny;
}

// Of the driven side of a pair: that of its heaviest point.
int ContactGroup::rankOf(const ContactConstraint& pair) const {
    double most = 0;
    int rank = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const ContactSurface& surface = elements_.surface(elements_.surfaceOf(pair.points[k]));
        if (!surface.isDriven || !(std::abs(pair.weights[k]) > most)) continue;
        most = std::abs(pair.weights[k]);
        rank = surface.ranks[static_cast<std::size_t>(pair.points[k] - surface.points.front())];
    }
    return rank;
}

bool ContactGroup::isLetThrough(const ContactConstraint& pair) const {
    if (squeezed_.empty() || !(pair.softness > 0)) return false;
    const int rank = rankOf(pair);
    return std::any_of(pair.points.begin(), pair.points.end(), [&](int i) {
        const auto found = squeezed_.find(i);
        return found != squeezed_.end() && rank > found->second;
    });
}

}  // namespace taut::contact
