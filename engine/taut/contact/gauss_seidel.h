// Projected Gauss-Seidel for one velocity field: sweeps over rows in their order, one impulse after the other, each
// clamped to what its row may do. The problem and its energy stand in solver.h.
//
// A sweep passes an impulse on by one layer of a pile, so sweeps alone are slow for high piles. Between two sweeps the
// impulses are extrapolated along the sum of the last changes, as in nonlinear conjugate gradients: Silcowitz-Abel,
// Niebe and Erleben 2010, "A nonsmooth nonlinear conjugate gradient method for interactive contact force problems".
//
// The start. Impulses that the rows have already are a guess, for instance those of the instant before. They are scaled
// by the factor for which the energy is least, 0 or more: so the start is no worse than without them.
//
// Plain data, for there is one copy of the kernel for each instruction set. Rows next to each other that share a
// velocity wait for one another in the processor; where they share none it works at several at once.
#pragma once

#include <span>

namespace taut::contact {

struct alignas(32) Four {
    double of[4];
};

// A direction along which the weighted sum of up to four velocities may not close.
struct Row {
    Four normal{};         // unit; last 0
    Four impulse{};        // [N s] friction along x, y, z; then along the normal
    double weights[4]{};   // of the velocities
    double gains[4]{};     // [1/kg] how much an impulse of 1 changes each velocity
    double mass = 0;       // [kg] effective, along the normal
    double closing = 0;    // [m/s] at which it may close in this instant; below 0: at which it has to part
    double friction = 0;   // Coulomb's μ [-]
    double largestGain = 0;  // [1/kg]
    int slots[4]{};        // of the velocities
    int source = 0;        // for its owner
};

// Changes the velocities (slots) [m/s], last 0, by the impulses. It ends after `sweeps`, or when a sweep changes no
// velocity by `tolerance` [m/s]. Returns the number of sweeps.
int projectedGaussSeidel(std::span<Row> rows, int sweeps, double tolerance, std::span<Four> velocities);

// What the kernel gets.
struct Sweeps {
    Row* rows;
    int count;
    Four* velocities;
    Four *changes, *direction;  // (count) scratch
    int most;
    double tolerance;  // [m/s]
};
namespace sse2 {
int sweep(const Sweeps& sweeps);
}
namespace avx2 {
int sweep(const Sweeps& sweeps);
}
namespace avx512 {
int sweep(const Sweeps& sweeps);
}

}  // namespace taut::contact
