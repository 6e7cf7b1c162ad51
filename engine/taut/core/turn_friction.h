// Resistance of a contact against the turn of its two sides on each other. Plain data.
#pragma once

namespace taut::core {

// [m] Largest torque over the force along the normal: across the normal, where one side rolls on the other, and about
// it, where one spins on the other. A contact has the sum of its sides.
struct TurnFriction {
    double rolling = 0, spin = 0;

    bool isNone() const { return rolling == 0 && spin == 0; }
    friend TurnFriction operator+(const TurnFriction& a, const TurnFriction& b) {
        return {a.rolling + b.rolling, a.spin + b.spin};
    }
};

}  // namespace taut::core
