// A hand that a mouse leads, as actions of a timeline: where the mouse wants it turns into grab, move and release in
// whole ticks and round numbers, so that a file can say exactly what was done. It knows neither mouse nor world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "taut/spec/actions.h"

namespace taut::live {

// A number as a file has it: to `decimals` places.
double rounded(double value, int decimals);

class Hand {
  public:
    static constexpr int moveTicks = 3;     // a move takes them all, and no other begins before its end
    static constexpr double fastest = 5.0;  // [m/s] of the scene's time: where motion is slow, a mouse is not

    Hand(std::string id, double ticksPerSecond) : id_(std::move(id)), ticksPerSecond_(ticksPerSecond) {}

    const std::string& id() const { return id_; }
    bool isHolding() const { return isHolding_; }

    // What the hand is to do next. grab: target "cloth.curtain@#12" and the points within `radius` [m] of it, by
    // springs of `strength` [N/m] in all and that damping ratio; `place` [m] is where that point is. It pulls with
    // `maxForce` [N] at most, and with any at 0.
    void grab(std::string target, double radius, double strength, double dampingRatio, glm::dvec3 place,
              double maxForce = 0.0);
    void leadTo(glm::dvec3 place);  // a way of less than 2 mm is none
    void release();

    // What happens at the start of this tick, in this order. To be asked once for every tick, in ascending order.
    world::Specs<world::ActionSpec> deedsAt(std::int64_t tick);

  private:
    template <class Own>
    Own action(std::int64_t tick) const;

    std::string id_;
    double ticksPerSecond_;
    std::optional<world::GrabAction> grab_;  // asked for, not done yet
    bool wantsRelease_ = false;
    bool isHolding_ = false;
    std::optional<glm::dvec3> goal_;  // [m] where the mouse wants it
    glm::dvec3 last_{0.0};            // [m] where the last move leads
    std::int64_t free_ = 0;           // the tick from which on another move may begin
};

}  // namespace taut::live
