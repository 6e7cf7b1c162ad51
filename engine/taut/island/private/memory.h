// What a tick changes of an island besides its points and its plan: a value. To keep it is a copy, to undo a tick an
// assignment, to save it a visit. It knows no island.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/island/private/dynamics.h"
#include "taut/island/report.h"
#include "taut/island/private/step_following.h"

namespace taut::world {

// By how much contact shortens the steps of "auto" at most.
inline constexpr int mostContactFactor = 1024;

// The energy that contact with colliders may add, in sum, and the steps that keep it within that.
//
// An impact shifts its point by up to v h against springs, which adds energy. A tick that adds more than a quarter of
// what is left of 2 % of the most energy that there was at a touch is taken again in steps half as long. So the sum
// stays below however many impacts come. After a second in which contact has added or taken next to nothing steps are
// as long again as they may.
struct ContactBudget {
    static constexpr double share = 0.02;   // of the most energy at a touch, in sum
    static constexpr double trifle = 0.01;  // of that: no reason to take a tick again

    ContactWork sum;                // so far; atTouch is the most at the first touch of any tick
    double most = 0;                // [J] that was added at any time
    int factor = 1, calmTicks = 0;  // by which steps are shorter; since when they need not be

    // [J] But for what contact itself has added: a collider that moves, a hand or the wind may have brought far more
    // than there was at the first touch of all.
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
    std::vector<collision::Contact> contacts;  // of the last tick's last step
    std::vector<ContactAcceleration> pressed;  // of its last instant
    std::vector<int> inside;                   // points that began inside a collider and have not been out yet
    bool hasTouched = false;                   // a contact yet
    ContactBudget budget;
    // Steps.
    StepFollowing following;              // where they follow the state
    int substeps = 1;                     // a tick
    double step = 0;                      // [s]
    std::vector<StepChange> stepChanges;  // so far
};

}  // namespace taut::world
