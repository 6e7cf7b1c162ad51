#include "taut/island/private/strength.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::world {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Square of (strain far from the tear / break strain) at which a tear of some 20 reference cells runs. Its broken
// springs make it longer by up to half a cell.
constexpr double evenShare = 0.08;
// Rounding alone does not count as yielding.
constexpr double beyond = 1 + 1e-6;

const PlasticitySpec* limitsIn(const IslandPlan& plan, int spring) {
    const SpringOrigin& origin = plan.origins[spring];
    return origin.body < 0 ? nullptr : &plan.bodies[origin.body]->plasticity;
}

const mechanics::Spring& madeAs(const IslandPlan& plan, int spring) {
    const SpringOrigin& origin = plan.origins[spring];
    return plan.bodies[origin.body]->model.springs[origin.spring];
}

// [m] side of the cell that a spring belongs to.
double cellOf(const mechanics::Spring& made) {
    return made.kind == mechanics::SpringKind::shear ? made.restLength / std::sqrt(2.0) : made.restLength;
}

}  // namespace

Strength::Strength(const IslandPlan& plan) : plan_(plan), first_(plan.points.size() + 1, 0) {
    for (const mechanics::Spring& s : plan.springs)
        for (const int end : {s.a, s.b}) ++first_[static_cast<std::size_t>(end) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    ways_.resize(first_.back());
    for (std::size_t s = 0; s < plan.springs.size(); ++s) {
        const auto [a, b] = std::pair(plan.springs[s].a, plan.springs[s].b);
        ways_[next[a]++] = {b, static_cast<int>(s)};
        ways_[next[b]++] = {a, static_cast<int>(s)};
    }
}

template <class Each>
bool Strength::anyNear(int point, Each&& each) const {
    if (each(point)) return true;
    return std::any_of(from(point).begin(), from(point).end(), [&](const Way& way) {
        const auto s = static_cast<std::size_t>(way.spring);
        return plan_.springs[s].kind == mechanics::SpringKind::structural && !plan_.broken[s] && each(way.to);
    });
}

bool Strength::isAtTip(int spring) const {
    const mechanics::Spring& s = plan_.springs[spring];
    // A broken diagonal has the sides of its cell beside it. They lie along the tear.
    const auto counts = [&](int other) {
        const auto kind = plan_.springs[other].kind;
        return plan_.broken[other] && (kind == mechanics::SpringKind::structural || kind == s.kind);
    };
    return anyNear(s.a, [&](int a) {
        // Looks for a broken spring that starts near one end and ends near the other.
        return std::any_of(from(a).begin(), from(a).end(), [&](const Way& way) {
            return counts(way.spring) && anyNear(s.b, [&](int b) { return b == way.to; });
        });
    });
}

double Strength::breakStrain(int spring) const {
    const PlasticitySpec* limits = limitsIn(plan_, spring);
    // Bending springs break with the springs along which they lie.
    if (limits == nullptr || !limits->breakStrain || isBend(spring)) return never;
    if (!isAtTip(spring)) return *limits->breakStrain;
    return *limits->breakStrain * std::sqrt(limits->breakCell / cellOf(madeAs(plan_, spring)) + evenShare);
}

mechanics::LengthLimits Strength::limitsOf(int spring) const {
    mechanics::LengthLimits limits;
    const auto s = static_cast<std::size_t>(spring);
    const PlasticitySpec* known = limitsIn(plan_, spring);
    const double restLength = plan_.springs[s].restLength;
    if (known == nullptr || plan_.broken[s] || !(restLength > 0)) return limits;
    if (const double strain = breakStrain(spring); strain < never)
        limits.most = (1 + strain) * madeAs(plan_, spring).restLength;
    if (!known->yieldStrain) return limits;
    const double yield = *known->yieldStrain * beyond;
    limits.most = std::min(limits.most, (1 + yield) * restLength);
    if (yield < 1) limits.least = (1 - yield) * restLength;
    return limits;
}

std::vector<mechanics::LengthLimits> Strength::limits() const {
    std::vector<mechanics::LengthLimits> all;
    for (std::size_t s = 0; s < plan_.springs.size(); ++s) all.push_back(limitsOf(static_cast<int>(s)));
    return all;
}

double Strength::overload(int spring, double l) const {
    const double strain = breakStrain(spring);
    if (!(strain < never)) return 0;
    const double made = madeAs(plan_, spring).restLength;
    return (l - made) / (made * strain);
}

double Strength::yieldedLength(int spring, double l) const {
    const double restLength = plan_.springs[spring].restLength;
    const PlasticitySpec* limits = limitsIn(plan_, spring);
    if (limits == nullptr || !limits->yieldStrain) return restLength;
    const double y = *limits->yieldStrain, strain = (l - restLength) / restLength;
    if (strain > y * beyond) return l / (1 + y);
    if (strain < -y * beyond && y < 1 && l > 0) return l / (1 - y);
    return restLength;
}

std::vector<int> Strength::firstToBreak(std::vector<Break> over) const {
    std::sort(over.begin(), over.end(), [](const Break& a, const Break& b) {
        return a.overload != b.overload ? a.overload > b.overload : a.spring < b.spring;
    });
    std::vector<bool> isRelieved(plan_.points.size(), false);
    std::vector<int> first;
    for (const Break& candidate : over) {
        const mechanics::Spring& s = plan_.springs[candidate.spring];
        if (isRelieved[s.a] || isRelieved[s.b]) continue;
        first.push_back(candidate.spring);
        for (const int end : {s.a, s.b})
            anyNear(end, [&](int point) {
                isRelieved[point] = true;
                return false;
            });
    }
    return first;
}

}  // namespace taut::world
