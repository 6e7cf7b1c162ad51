// All that a tick changes of an island besides its points and its plan, as a value. Keeping it is a copy, undoing a
// tick an assignment, saving it a visit. It knows no island.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/island/private/dynamics.h"
#include "taut/island/private/step_following.h"
#include "taut/island/report.h"

namespace taut::world {

// Largest factor by which contact shortens the steps of "auto".
inline constexpr int mostContactFactor = 1024;

// How much energy contact with colliders may add in all, and the steps that keep it below that.
//
// An impact shifts its point by up to v h against springs, which adds energy. The budget is 2 % of the most energy at
// any touch. A tick that adds more than a quarter of the rest is repeated in steps half as long, so the sum stays below
// the budget for any number of impacts. After a second in which contact has changed the energy by next to
// nothing, steps become longer again.
struct ContactBudget {
    static constexpr double share = 0.02;   // of the most energy at a touch, for the sum
    static constexpr double trifle = 0.01;  // of the budget: too little to repeat a tick

    ContactWork sum;                // so far; atTouch is the largest at the first touch of any tick
    double most = 0;                // [J] largest sum at any time
    int factor = 1, calmTicks = 0;  // by which steps are shorter; ticks since they need not be

    // [J] The most energy at a touch, without the energy added by contact itself. A moving collider, a hand or the wind
    // may have brought far more energy than there was at the very first touch.
    double energyAtTouch(const ContactWork& work) const {
        return std::max(sum.atTouch, work.atTouch - std::max(sum.added, 0.0));
    }
    bool isExceededBy(const ContactWork& work) const {
        const double atTouch = energyAtTouch(work);
        const double left = 0.9 * share * atTouch - std::max(sum.added, 0.0);
        return atTouch > 0 && work.added > std::max(0.25 * left, trifle * share * atTouch);
    }
    void add(const ContactWork& work, double tickSeconds) {
        sum.atTouch = energyAtTouch(work);
        sum.added += work.added;
        most = std::max(most, sum.added);
        if (factor == 1) return;
        const bool isCalm = std::abs(work.added) < trifle * share * sum.atTouch;
        calmTicks = isCalm ? calmTicks + 1 : 0;
        if (calmTicks * tickSeconds < 1.0) return;
        factor /= 2;
        calmTicks = 0;
    }
    bool isOverdrawn() const { return most > share * sum.atTouch && sum.atTouch > 0; }
};

struct IslandMemory {
    // Contact with colliders, and with other bodies.
    std::vector<collision::Contact> contacts;  // of the last step of the last tick
    std::vector<ContactAcceleration> pressed;  // of the last step of contact in that tick
    std::vector<int> inside;                   // points that began inside a collider and have not been out yet
    bool hasTouched = false;                   // in any step so far
    ContactBudget budget;
    // Steps.
    StepFollowing following;              // for steps that follow the state
    int substeps = 1;                     // a tick
    double step = 0;                      // [s]
    std::vector<StepChange> stepChanges;  // so far
};

}  // namespace taut::world
