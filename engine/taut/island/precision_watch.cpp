#include "taut/island/private/precision_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/island/private/step_choice.h"

namespace taut::world {
namespace {

constexpr double lostShare = 0.01;  // of a body's size, by which rounding may keep a point back
constexpr int looksEvery = 64;      // ticks
constexpr double considered = 1.0;  // [s] for which a speed is assumed to last

std::string warningOf(const IslandPlan& plan, const Dynamics& dynamics, int point, int plane, double step,
                      const std::string& limitingSpring) {
    const dvec3 x = dynamics.position(point);
    const auto [body, number] = authored(plan, point);
    const double speed = dynamics.freezingSpeed(x[plane]);
    char text[400];
    std::snprintf(text, sizeof text,
                  ": in single precision point %d at [%.4g, %.4g, %.4g] does not move along %c below %.2g m/s: "
                  "rounding removes the motion of a step of %s; give precision = \"double\", or longer steps",
                  number, x.x, x.y, x.z, "xyz"[plane], speed, inSeconds(step).c_str());
    const bool isSet = !plan.solver.dt && !limitingSpring.empty();
    return (body != nullptr ? body : plan.bodies.front())->fullName() + text +
           (isSet ? "; set by the " + limitingSpring : "");
}

}  // namespace

void PrecisionWatch::foresee(const IslandPlan& plan, const Dynamics& dynamics, double t, double tickSeconds,
                             double step, const std::string& limitingSpring) {
    if (plan.solver.precision == Precision::double_) return;
    const dvec3 gravity = dynamics.gravity(t);
    const double fall = tickSeconds * std::sqrt(glm::dot(gravity, gravity));
    for (int i = 0; i < static_cast<int>(plan.points.size()); ++i) {
        if (!isFree(plan, i)) continue;
        const auto k = static_cast<std::size_t>(i);
        for (int p = 0; p < 3; ++p) {
            const double v = std::abs(plan.velocities[k][p]);
            const double speed = v * considered > lostShare ? v : fall;
            if (!(speed > 0) || speed >= dynamics.freezingSpeed(plan.positions[k][p])) continue;
            warning_ = warningOf(plan, dynamics, i, p, step, limitingSpring);
            return;
        }
    }
}

// A tick is looked at only if a second at the freezing speed is a noticeable way.
void PrecisionWatch::look(const IslandPlan& plan, Dynamics& dynamics, double tickSeconds, double step,
                          const std::string& limitingSpring) {
    if (plan.solver.precision == Precision::double_ || !warning_.empty()) return;
    if (--ticksToLook_ < 0) {
        ticksToLook_ = looksEvery;
        dynamics.positions(x_);
        dvec3 low(HUGE_VAL), high(-HUGE_VAL);
        for (const dvec3& x : x_) {
            low = glm::min(low, x);
            high = glm::max(high, x);
        }
        const dvec3 size = high - low, far = glm::max(glm::abs(low), glm::abs(high));
        const double largest = std::max({size.x, size.y, size.z});
        mayLose_ = lostShare * (largest > 0 ? largest : 1.0);
        if (!(dynamics.freezingSpeed(std::max({far.x, far.y, far.z})) * considered > mayLose_)) mayLose_ = 0;
    }
    if (!(mayLose_ > 0)) return;
    const Dynamics::Lost lost = dynamics.lost(tickSeconds, mayLose_);
    if (lost.point >= 0) warning_ = warningOf(plan, dynamics, lost.point, lost.plane, step, limitingSpring);
}

void PrecisionWatch::visit(StateBytes& bytes) {
    bytes.raw(mayLose_);
    bytes(ticksToLook_);
}

}  // namespace taut::world
