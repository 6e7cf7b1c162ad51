// Projected Gauss-Seidel for one velocity field: sweeps over the pairs in their order, one impulse after the other,
// each clamped to what its pair may do. The problem and its energy stand in solver.h.
//
// A sweep passes an impulse on by one layer of a pile, so sweeps alone are slow for high piles. Between two sweeps the
// impulses are extrapolated along the sum of the last changes, as in nonlinear conjugate gradients: Silcowitz-Abel,
// Niebe and Erleben 2010, "A nonsmooth nonlinear conjugate gradient method for interactive contact force problems".
#pragma once

#include <span>
#include <vector>

#include "taut/contact/contact_constraint.h"

namespace taut::contact {

// A point in contact with a collider. It does not go into the collider, and the impulses of pairs that press it there
// raise the limit of its friction.
struct KinematicContact {
    int point;
    dvec3 normal;           // unit, out of the collider
    double speed;           // [m/s] of the collider's surface along the normal
    dvec3 carried{0.0};     // [m/s] velocity of the collider's surface
    double friction = 0.0;  // Coulomb's μ of point and surface [-]
};

struct Impulse {
    double normal = 0;    // [N s]
    dvec3 friction{0.0};  // [N s] tangential
};

// A pair in the solver.
struct Row {
    int pair;
    std::array<double, 4> gains{};  // [1/kg] velocity of its points for an impulse of 1: weight × inverse mass
    double largestGain = 0;         // [1/kg]
    double mass = 0;                // [kg] effective mass along the normal
    double gapSpeed = 0;            // [m/s] at which the pair may close in this instant
    double rebound = 0;             // [m/s] at which it has to part
    Impulse impulse{};
};

// A contact of a point with a collider in the solver. Its impulse is what the pairs cause, beyond what the point's
// island has already given it.
struct KinematicRow {
    KinematicContact contact;
    double mass = 0;  // [kg] of the point
    Impulse impulse{};
};

// Changes u (points) [m/s] by the impulses. Impulses that the rows already have are applied first. It ends after
// `sweeps`, or when a sweep changes no velocity by `tolerance` [m/s]. Returns the number of sweeps.
int projectedGaussSeidel(std::span<const ContactConstraint> pairs, std::span<Row> rows,
                         std::span<KinematicRow> kinematicRows, int sweeps, double tolerance, std::span<dvec3> u);

}  // namespace taut::contact
