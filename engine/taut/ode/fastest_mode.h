// The quantities from which the largest stable step of a method is computed. It knows no method.
#pragma once

namespace taut::ode {

// A bound of the fastest motion of a system, which limits the step.
struct FastestMode {
    double omega = 0;        // ω [1/s], stiffness over mass
    double tau = 0;          // [s] dashpots c = τ k
    double rate = 0;         // [1/s] other explicit damping: wind, anchors
    double drag = 0;         // [1/s] smallest drag rate γ of a free point
    double largestDrag = 0;  // [1/s] largest of them
};

}  // namespace taut::ode
