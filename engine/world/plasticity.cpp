// Springs that give way and break, looked at once a tick.
#include <algorithm>
#include <cmath>

#include "taut/world/cutting.h"
#include "taut/world/island.h"

namespace taut::world {
namespace {

// Rounding alone is no yielding.
constexpr double beyond = 1 + 1e-6;

// The rest length that leaves a spring of length l strained by no more than the yield strain y, or the one that it has.
double yieldedLength(double l, double restLength, double y) {
    const double strain = (l - restLength) / restLength;
    if (strain > y * beyond) return l / (1 + y);
    if (strain < -y * beyond && y < 1 && l > 0) return l / (1 - y);
    return restLength;
}

}  // namespace

// Beyond the break strain, against the length that it was made with, a spring is gone; beyond the yield strain its
// rest length follows, so that the elastic strain stays at it.
bool Island::settle(const TickTime& time) {
    if (!mayGiveWay_ || frozen_) return false;
    dynamics_->positions(x_);
    std::vector<std::pair<std::size_t, double>> yielded;  // spring, new rest length
    Crossing torn;
    for (std::size_t s = 0; s < plan_.springs.size(); ++s) {
        const SpringOrigin& origin = plan_.origins[s];
        const double restLength = plan_.springs[s].restLength;
        if (origin.body < 0 || plan_.broken[s] || !(restLength > 0)) continue;
        Body* body = plan_.bodies[static_cast<std::size_t>(origin.body)];
        const PlasticitySpec& limits = body->plasticity;
        if (!limits.yieldStrain && !limits.breakStrain) continue;
        const double l = lengthOf(plan_.springs[s], x_);
        const mechanics::Spring& made = body->model.springs[static_cast<std::size_t>(origin.spring)];
        // Springs of bending break with those that they lie along.
        if (limits.breakStrain && made.kind != mechanics::SpringKind::bend &&
            l > (1 + *limits.breakStrain) * made.restLength)
            torn.edges.push_back({body, made.a, made.b, 0.5});
        else if (limits.yieldStrain)
            if (const double next = yieldedLength(l, restLength, *limits.yieldStrain); next != restLength)
                yielded.emplace_back(s, next);
    }
    if (yielded.empty() && torn.isEmpty()) return false;
    IslandPlan& plan = change(time, torn.isEmpty() ? Change::lengths : Change::shape);
    for (const auto& [s, restLength] : yielded) plan.springs[s].restLength = restLength;
    if (!torn.isEmpty()) sever(torn, plan);
    close(time);
    return !torn.isEmpty();
}

void Island::watchPlasticity() {
    mayGiveWay_ = std::any_of(
        plan_.bodies.begin(), plan_.bodies.end(),
        [](const Body* body) { return body->plasticity.yieldStrain || body->plasticity.breakStrain; });
}

}  // namespace taut::world
