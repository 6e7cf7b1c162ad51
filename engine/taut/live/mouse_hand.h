// Turns the motion of a mouse into actions of a timeline: grab, move and release, in ticks and round numbers, so that a
// file can reproduce them exactly. Independent of the mouse and the world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "taut/spec/actions.h"

namespace taut::live {

// A number as a file writes it: to `decimals` places.
double rounded(double value, int decimals);

class MouseHand {
  public:
    static constexpr int moveTicks = 3;     // a move takes so many, and the next begins after it
    static constexpr double fastest = 5.0;  // [m/s] in the scene's time: in slow motion a mouse is faster

    MouseHand(std::string id, double ticksPerSecond) : id_(std::move(id)), ticksPerSecond_(ticksPerSecond) {}

    // The moment of a tick as a file writes it [s].
    static double momentOf(std::int64_t tick, double ticksPerSecond);

    const std::string& id() const { return id_; }
    bool isHolding() const { return isHolding_; }

    // The next action of the hand. grab() takes the target "cloth.curtain@#12" and the points within `radius` [m] of
    // it, by springs of `strength` [N/m] in total with that damping ratio; `place` [m] is the target's place. It pulls
    // with at most `maxForce` [N]; 0: no limit.
    void grab(std::string target, double radius, double strength, double dampingRatio, glm::dvec3 place,
              double maxForce = 0.0);
    void leadTo(glm::dvec3 place);  // ways of less than 2 mm are ignored
    void release();

    // The actions at the start of this tick, in their order. Call it once for every tick, in ascending order.
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
    glm::dvec3 last_{0.0};            // [m] where the last move ends
    std::int64_t free_ = 0;           // the first tick at which another move may begin
};

}  // namespace taut::live
