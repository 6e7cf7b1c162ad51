#include "taut/live/mouse_hand.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut::live {
namespace {

constexpr int placeDecimals = 3;     // [m]: to the millimetre
constexpr double leastWay = 0.002;   // [m]
constexpr int timeDecimals = 6;      // [s]: far finer than a tick
constexpr int forceDecimals = 3;     // [N]
constexpr double leastForce = 1e-3;  // [N]

glm::dvec3 roundedPlace(const glm::dvec3& place) {
    return {rounded(place.x, placeDecimals), rounded(place.y, placeDecimals), rounded(place.z, placeDecimals)};
}

}  // namespace

double rounded(double value, int decimals) {
    double scale = 1.0;
    for (int i = 0; i < decimals; ++i) scale *= 10.0;
    const double result = std::round(value * scale) / scale;  // the number nearest to its decimals, as a reader has it
    return result == 0.0 ? 0.0 : result;                      // no minus zero
}

double MouseHand::momentOf(std::int64_t tick, double ticksPerSecond) {
    return rounded(static_cast<double>(tick) / ticksPerSecond, timeDecimals);
}

template <class Own>
Own MouseHand::action(std::int64_t tick) const {
    Own action;
    action.id = id_;
    action.t = momentOf(tick, ticksPerSecond_);
    return action;
}

void MouseHand::grab(std::string target, double radius, double strength, double dampingRatio, glm::dvec3 place,
                     double maxForce) {
    if (isHolding_) wantsRelease_ = true;
    auto grab = action<world::GrabAction>(0);
    grab.target = std::move(target);
    grab.radius = rounded(radius, placeDecimals);
    grab.strength = strength;
    grab.dampingRatio = dampingRatio;
    if (maxForce > 0.0) grab.maxForce = std::max(rounded(maxForce, forceDecimals), leastForce);
    grab_ = std::move(grab);
    goal_.reset();
    last_ = roundedPlace(place);
}

void MouseHand::leadTo(glm::dvec3 place) {
    if (glm::length(place - goal_.value_or(last_)) > leastWay) goal_ = roundedPlace(place);
}

void MouseHand::release() {
    grab_.reset();  // a click shorter than a tick
    if (isHolding_) wantsRelease_ = true;
}

world::Specs<world::ActionSpec> MouseHand::deedsAt(std::int64_t tick) {
    world::Specs<world::ActionSpec> deeds;
    if (wantsRelease_) {
        deeds.add(action<world::ReleaseAction>(tick));
        wantsRelease_ = isHolding_ = false;
    }
    if (grab_) {
        grab_->t = action<world::GrabAction>(tick).t;
        deeds.add(*std::exchange(grab_, std::nullopt));
        isHolding_ = true;
        free_ = tick;
    }
    if (isHolding_ && goal_ && *goal_ != last_ && tick >= free_) {
        auto move = action<world::MoveAction>(tick);
        const glm::dvec3 way = *goal_ - last_;
        const double most = fastest * moveTicks / ticksPerSecond_, length = glm::length(way);
        last_ = length > most ? roundedPlace(last_ + way * (most / length)) : *goal_;
        move.to = last_;
        move.over = rounded(moveTicks / ticksPerSecond_, timeDecimals);
        move.ease = world::Ease::linear;
        deeds.add(std::move(move));
        free_ = tick + moveTicks;
    }
    return deeds;
}

}  // namespace taut::live
