// Projected Gauss-Seidel for one velocity field: sweeps over rows in their order, one impulse after the other, each
// clamped to what its row may do. The problem and its energy stand in solver.h.
//
// A sweep passes an impulse on by one layer of a pile, so sweeps alone are slow for high piles. Between two sweeps the
// impulses are extrapolated along the sum of the last changes, as in nonlinear conjugate gradients: Silcowitz-Abel,
// Niebe and Erleben 2010, "A nonsmooth nonlinear conjugate gradient method for interactive contact force problems".
//
// The start. Impulses that the rows have already are a guess, for instance those of the step before. They are scaled by
// the factor for which the energy is least, 0 or more: so the start is no worse than without them. Where there is but
// one sweep a step, a fixed share of them is a good start, and the search for the factor would cost more than the
// sweep.
//
// Softness. Two things that nothing moves may close on a third, and no impulses keep both. Where rows are soft, their
// impulses end at the closing speed divided by the softness, instead of growing for ever.
//
// Solids. In place of the points of a rigid body, a row has the velocity of the body's centre, which is in the
// points' slots, and its spin, which is in a slot of its own (Turn). Where more than four velocities move the
// points of a row, the others are its shares.
//
// Rolling. A row between solids may also have a torque against their turn on each other (Roll): across the normal and
// about it, each at most a length times the normal impulse. A visit clamps it after friction.
//
// Four rows at a time. A row waits for the rows before it that share a velocity with it, and for no others. So rows are
// put into levels, each one above the highest of those it waits for, and go through the processor in packs of four of
// one level. The result is that of the rows one after the other, bit for bit; sums over rows are in their order.
#pragma once

#include <span>
#include <vector>

#include "taut/core/turn_friction.h"

namespace taut::contact {

struct alignas(32) Four {
    double of[4];
};

// A rigid body of which a row has points: these have spin × arm besides the velocity of their slots.
struct Turn {
    int slot = 0;       // of the spin [rad/s]
    double arm[3]{};    // [m] sum of the points' weights × (place of the impulse - centre of mass)
    double gain[9]{};   // [1/(kg m²)] inverse inertia, symmetric
    double weight = 0;  // sum of the points' weights: 1 of the first side, -1 of the second
};
// The torque of a row against the turn of its sides on each other.
struct Roll {
    core::TurnFriction friction;
    double across = 0, about = 0;  // [kg m²] effective inertia, the least across the normal, and about it
    double reach = 0;              // [m] of the longest arm of the row: a spin times it is a velocity
    Four driven{};                 // [rad/s] spin of a collider, the second side; last 0
    Four impulse{};                // [N m s] on the first side; last 0
};
// A further velocity of a row.
struct Share {
    int slot = 0;
    double weight = 0;
    double gain = 0;  // [1/kg]
};
// Some that stand together.
struct Range {
    int first = 0, last = 0;
    bool isEmpty() const { return first == last; }
    template <class T>
    std::span<const T> of(std::span<const T> all) const {
        return all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
    }
};
// Further velocities of rows besides their four.
struct Levers {
    std::span<const Turn> turns;
    std::span<const Share> shares;
    std::span<Roll> rolls{};
};

// A direction along which the weighted sum of some velocities may not close.
struct Row {
    Four normal{};           // unit; last 0
    Four impulse{};          // [N s] friction along x, y, z; then along the normal
    double weights[4]{};     // of the velocities
    double gains[4]{};       // [1/kg] how much an impulse of 1 changes each velocity
    double mass = 0;         // [kg] effective, along the normal
    double grip = 0;         // [kg] effective, the least across the normal; 0: as along it
    double closing = 0;      // [m/s] at which it may close in this step; below 0: at which it has to part
    double friction = 0;     // Coulomb's μ [-]
    double softness = 0;     // [m/s] by which it may close further for each impulse of 1
    double least = 0;        // [N s] of the impulse along the normal: below 0 of a joint, which also pulls
    double largestGain = 0;  // [1/kg]
    int slots[4]{};          // of the velocities
    Range turns, shares;     // of the levers
    int roll = -1;           // number of its torque; -1: none
    int source = 0;          // for its owner
};

// Meaning of the initial impulses of rows: a guess, applied to the velocities, or those of the step before.
enum class Start { guessed, applied, kept };

// Changes the velocities (slots) [m/s], last 0, by the impulses. It ends after `sweeps`, or when a sweep changes no
// velocity by `tolerance` [m/s]. Returns the number of sweeps.
int projectedGaussSeidel(std::span<Row> rows, int sweeps, double tolerance, std::span<Four> velocities,
                         const Levers& levers = {}, Start start = Start::guessed);

// Input of the kernel: rows lane by lane. A lane without a row is all 0, and has the first lane's slots.
struct Pack {
    Four normal[3]{};
    Four impulse[4]{}, change[4]{}, direction[4]{};  // [N s]
    Four weights[4]{}, gains[4]{};
    Four mass{}, grip{}, closing{}, friction{}, softness{}, least{}, largestGain{};
    Four gap{}, base{};  // [m], [m/s] closing without it: see Sweeps::gone
    int slots[4][4]{};   // lane, velocity
    bool hasLevers = false;
    bool rolls = false;             // whether a lane has a roll
    Range turns[4]{}, shares[4]{};  // lane
    int roll[4]{-1, -1, -1, -1};    // lane
    int rows[4]{};                  // lane; the number of rows where there is none
};
struct Sweeps {
    Pack* packs;
    int packCount;
    int rowCount;
    double* perRow;  // (rows + 1) scratch
    Four* velocities;
    const Turn* turns;
    const Share* shares;
    Roll* rolls;
    int most;
    double tolerance;  // [m/s]
    Start start;
    // (slots) [m] Integral of the velocities since gaps were measured, and 1 over the length of the step [1/s];
    // null: gaps do not count.
    const Four* gone = nullptr;
    double perSecond = 0;
};

// Rows that are swept in many steps. They keep their order, and the gaps from which they started: a row may close by
// what is left of its gap within a step.
class RowPacks {
  public:
    // gaps (rows) [m]: a row may close by the rest of its gap, in addition to `closing`.
    void take(std::span<const Row> rows, std::span<const double> gaps, std::size_t slotCount, const Levers& levers);
    // One step of h [s]. As projectedGaussSeidel(), from the impulses of the step before. gone (slots) [m]: since the
    // gaps were measured.
    void sweep(int sweeps, double tolerance, double h, std::span<Four> velocities, std::span<const Four> gone,
               const Levers& levers);
    // Gives the rows their impulses.
    void read(std::span<Row> rows) const;

  private:
    std::vector<Pack> packs_;
    std::vector<double> perRow_;
    int rowCount_ = 0;
};

}  // namespace taut::contact
