// Compiled once for each instruction set (engine/taut.cmake). The lanes of a vector are x, y, z and nothing, or the
// normal part of an impulse; sums across lanes are in their order, so every width gives the same bits.
#include "taut/contact/gauss_seidel.h"

namespace taut::contact::TAUT_ISA {
namespace {

// Without AVX the compiler warns that vectors of four doubles are passed otherwise than with it. All of this is inline.
#pragma GCC diagnostic ignored "-Wpsabi"
typedef double Lanes __attribute__((vector_size(32)));

inline Lanes load(const Four& from) {
    Lanes lanes;
    __builtin_memcpy(&lanes, &from, sizeof lanes);
    return lanes;
}
inline void store(Four& to, const Lanes& lanes) {
    __builtin_memcpy(&to, &lanes, sizeof lanes);
}
inline double dot(const Lanes& a, const Lanes& b) {
    const Lanes product = a * b;
    return product[0] + product[1] + product[2];
}
inline bool isZero(const Lanes& impulse) {
    return impulse[0] == 0 && impulse[1] == 0 && impulse[2] == 0 && impulse[3] == 0;
}

inline Lanes relativeVelocity(const Row& row, const Four* velocities) {
    return row.weights[0] * load(velocities[row.slots[0]]) + row.weights[1] * load(velocities[row.slots[1]]) +
           row.weights[2] * load(velocities[row.slots[2]]) + row.weights[3] * load(velocities[row.slots[3]]);
}
inline void apply(const Row& row, Lanes impulse, Four* velocities) {
    const double along = impulse[3];
    impulse[3] = 0;
    impulse += along * load(row.normal);
    for (int k = 0; k < 4; ++k) {
        Four& own = velocities[row.slots[k]];
        store(own, load(own) + row.gains[k] * impulse);
    }
}

// Solves one row for the current velocities: first the normal impulse, then friction. Returns how its impulse changed.
inline Lanes visit(Row& row, Four* velocities) {
    const Lanes normal = load(row.normal), before = load(row.impulse), velocity = relativeVelocity(row, velocities);
    const double parting = dot(normal, velocity), wanted = before[3] - row.mass * (parting + row.closing);
    Lanes next{0, 0, 0, 0};
    if (row.friction > 0) {
        // Coulomb's friction: in the disk around 0.
        next = before - row.mass * (velocity - parting * normal);
        const double limit = row.friction * (wanted > 0 ? wanted : 0), square = dot(next, next);
        if (square > limit * limit) next *= limit / __builtin_sqrt(square);
    }
    next[3] = wanted > 0 ? wanted : 0;
    const Lanes change = next - before;
    if (isZero(change)) return change;
    store(row.impulse, next);
    apply(row, change, velocities);
    return change;
}

// λ · (W u + closing), the slope of the energy along the impulses.
inline double slope(const Sweeps& batch) {
    double sum = 0;
    for (int r = 0; r < batch.count; ++r) {
        const Row& row = batch.rows[r];
        const Lanes impulse = load(row.impulse), velocity = relativeVelocity(row, batch.velocities);
        sum += impulse[3] * (dot(load(row.normal), velocity) + row.closing) + dot(impulse, velocity);
    }
    return sum;
}

// Applies the impulses that the rows have, times what makes the energy least.
inline void start(const Sweeps& batch) {
    bool isCold = true;
    for (int r = 0; r < batch.count; ++r) isCold = isCold && isZero(load(batch.rows[r].impulse));
    if (isCold) return;
    const double before = slope(batch);
    for (int r = 0; r < batch.count; ++r) apply(batch.rows[r], load(batch.rows[r].impulse), batch.velocities);
    const double rise = slope(batch) - before;  // λᵀ A λ
    const double share = before < 0 && rise > 0 ? -before / rise : 0.0;
    for (int r = 0; r < batch.count; ++r) {
        Row& row = batch.rows[r];
        const Lanes impulse = load(row.impulse);
        apply(row, (share - 1) * impulse, batch.velocities);
        store(row.impulse, share * impulse);
    }
}

}  // namespace

int sweep(const Sweeps& batch) {
    start(batch);
    for (int r = 0; r < batch.count; ++r) batch.direction[r] = Four{};
    double squareBefore = 0;
    for (int sweep = 1;; ++sweep) {
        // A sweep. It records the largest squared change of a velocity [(m/s)²], and the sum of the squared changes of
        // impulses [(N s)²].
        double largest = 0, square = 0;
        for (int r = 0; r < batch.count; ++r) {
            Row& row = batch.rows[r];
            const Lanes change = visit(row, batch.velocities);
            store(batch.changes[r], change);
            const double own = dot(change, change) + change[3] * change[3];
            const double fastest = row.largestGain * row.largestGain * own;
            largest = fastest > largest ? fastest : largest;
            square += own;
        }
        if (sweep == batch.most || largest < batch.tolerance * batch.tolerance) return sweep;

        // How far to extrapolate, after Fletcher and Reeves. If the changes grow, the direction starts anew.
        const double share = squareBefore > 0 ? square / squareBefore : 0.0;
        squareBefore = square;
        if (share > 1.0) {
            for (int r = 0; r < batch.count; ++r) batch.direction[r] = Four{};
            continue;
        }

        // The extrapolation. If it goes too far, the next sweep clamps it.
        for (int r = 0; r < batch.count; ++r) {
            Row& row = batch.rows[r];
            const Lanes step = share * load(batch.direction[r]);
            store(batch.direction[r], step + load(batch.changes[r]));
            if (isZero(step)) continue;
            store(row.impulse, load(row.impulse) + step);
            apply(row, step, batch.velocities);
        }
    }
}

}  // namespace taut::contact::TAUT_ISA
