// What an island is watched for besides its bounds: energy that contact adds, and motion that rounding loses.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "taut/island/island.h"

namespace taut::world {
namespace {

constexpr double mostAdded = 0.02;  // of the most energy at a touch, in sum
constexpr double trifle = 0.01;     // of that
constexpr double lostShare = 0.01;  // of a body's size, that rounding may keep a point back
constexpr int looksEvery = 64;      // ticks
constexpr double considered = 1.0;  // [s] for which a speed is taken to last

}  // namespace

// [J] The most at the first touch of any tick, but for what contact itself has added: a collider that moves, a hand or
// the wind may have brought far more than there was at the first of all.
double Island::energyAtTouch(const ContactWork& work) const {
    return std::max(contactWork_.atTouch, work.atTouch - std::max(contactWork_.added, 0.0));
}

// A quarter of what is left to add: so the sum stays below, however many impacts come. A trifle is no reason.
bool Island::addsTooMuch(const ContactWork& work) const {
    if (!shortensForContact_ || contactFactor_ >= mostContactFactor || 2 * choice_.substeps > mostSubsteps)
        return false;
    const double atTouch = energyAtTouch(work);
    const double left = 0.9 * mostAdded * atTouch - std::max(contactWork_.added, 0.0);
    return atTouch > 0 && work.added > std::max(0.25 * left, trifle * mostAdded * atTouch);
}

// After a second in which contact has added or taken next to nothing steps are as long again as they may.
void Island::account(const ContactWork& work) {
    contactWork_.atTouch = energyAtTouch(work);
    contactWork_.added += work.added;
    mostContactWork_ = std::max(mostContactWork_, contactWork_.added);
    if (contactFactor_ == 1) return;
    const bool isCalm = std::abs(work.added) < trifle * mostAdded * contactWork_.atTouch;
    calmTicks_ = isCalm ? calmTicks_ + 1 : 0;
    if (calmTicks_ * tickSeconds_ < 1.0) return;
    contactFactor_ /= 2;
    calmTicks_ = 0;
}

std::string Island::contactWarning() const {
    if (!(mostContactWork_ > mostAdded * contactWork_.atTouch) || !(contactWork_.atTouch > 0)) return {};
    char text[300];
    std::snprintf(
        text, sizeof text,
        ": contact has added %.2g J, %.0f %% of the most energy at a touch: what a step of %s leads into a "
        "collider is brought out of it against its springs; ",
        mostContactWork_, 100.0 * mostContactWork_ / contactWork_.atTouch, inSeconds(choice_.step).c_str());
    return plan_.bodies.front()->fullName() + text +
           (plan_.solver.dt ? "give dt = \"auto\", or a shorter one" : "give a shorter dt, or less restitution");
}

std::string Island::freezingWarning(int point, int plane) const {
    const dvec3 x = position(point);
    const auto [body, number] = authored(plan_, point);
    const double speed = dynamics_->freezingSpeed(x[plane]);
    char text[400];
    std::snprintf(
        text, sizeof text,
        ": in single precision point %d at [%.4g, %.4g, %.4g] does not move along %c below %.2g m/s: rounding "
        "takes what a step of %s adds to the coordinate; give precision = \"double\", or longer steps",
        number, x.x, x.y, x.z, "xyz"[plane], speed, inSeconds(choice_.step).c_str());
    const bool isSet = !plan_.solver.dt && !choice_.limitingSpring.empty();
    return (body != nullptr ? body : plan_.bodies.front())->fullName() + text +
           (isSet ? "; set by the " + choice_.limitingSpring : "");
}

// Frozen from the start: below what gravity gives in a tick, along whichever axis, or at the speed that it is given.
void Island::foreseeFreezing(double t) {
    if (plan_.solver.precision == Precision::double_) return;
    const dvec3 gravity = dynamics_->gravity(t);
    const double fall = tickSeconds_ * std::sqrt(glm::dot(gravity, gravity));
    for (int i = 0; i < static_cast<int>(plan_.points.size()); ++i) {
        if (!isFree(plan_, i)) continue;
        const auto k = static_cast<std::size_t>(i);
        for (int p = 0; p < 3; ++p) {
            const double v = std::abs(plan_.velocities[k][p]);
            const double speed = v * considered > lostShare ? v : fall;
            if (!(speed > 0) || speed >= dynamics_->freezingSpeed(plan_.positions[k][p])) continue;
            freezingWarning_ = freezingWarning(i, p);
            return;
        }
    }
}

// What moves at the freezing speed for a second has to lose a noticeable way before each tick is looked at.
void Island::watchFreezing(const TickTime& time) {
    if (plan_.solver.precision == Precision::double_ || !freezingWarning_.empty()) return;
    if (--ticksToLook_ < 0) {
        ticksToLook_ = looksEvery;
        dynamics_->positions(x_);
        dvec3 low(HUGE_VAL), high(-HUGE_VAL);
        for (const dvec3& x : x_) {
            low = glm::min(low, x);
            high = glm::max(high, x);
        }
        const dvec3 size = high - low, far = glm::max(glm::abs(low), glm::abs(high));
        const double largest = std::max({size.x, size.y, size.z});
        mayLose_ = lostShare * (largest > 0 ? largest : 1.0);
        if (!(dynamics_->freezingSpeed(std::max({far.x, far.y, far.z})) * considered > mayLose_)) mayLose_ = 0;
    }
    if (!(mayLose_ > 0)) return;
    const Dynamics::Lost lost = dynamics_->lost(1.0 / time.ticksPerSecond, mayLose_);
    if (lost.point >= 0) freezingWarning_ = freezingWarning(lost.point, lost.plane);
}

}  // namespace taut::world
