// Impulses of pairs that hang together, for one field of velocities: projected Gauss-Seidel over them in their order,
// and between two sweeps a step on along the way of the sweeps before, as in nonlinear conjugate gradients
// (Silcowitz-Abel, Niebe and Erleben 2010, "A nonsmooth nonlinear conjugate gradient method for interactive contact
// force problems"). Sweeps alone pass an impulse on by one layer of a pile each.
#pragma once

#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"

namespace taut::contact {

// A point that a collider holds: it does not go into it, and what presses it there lets friction hold it the more.
struct KinematicContact {
    int point;
    dvec3 normal;           // unit, out of the collider
    double speed;           // [m/s] of the surface along it
    dvec3 carried{0.0};     // [m/s] of the surface
    double friction = 0.0;  // Coulomb's μ of point and surface [-]
};

struct Impulse {
    double normal = 0;  // [N s]
    dvec3 rub{0.0};     // [N s] of friction
};

// A pair.
struct Row {
    int pair;
    std::array<double, 4> gains{};  // [1/kg] of its points, by its weights
    double most = 0;                // [1/kg] of them
    double mass = 0;                // [kg] that the pair's points have along the normal together
    double open = 0;                // [m/s] they may approach each other with
    double bounce = 0;              // [m/s] they have to part with
    Impulse impulse{};
};

// What a collider gives a point besides what it gave it before.
struct KinematicRow {
    KinematicContact held;
    double mass = 0;  // [kg] of the point
    Impulse impulse{};
};

// Velocities u [m/s] (points) become what they are after impulses, first of all those that rows and kinematicRows have
// already. Ends after `sweeps`, or when no velocity changes by `little` [m/s] any more. Returns how many there were.
int projectedGaussSeidel(std::span<const ContactConstraint> pairs, std::span<Row> rows,
                         std::span<KinematicRow> kinematicRows, int sweeps, double little, std::span<dvec3> u);

}  // namespace taut::contact
