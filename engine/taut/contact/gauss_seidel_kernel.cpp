// Compiled once for each instruction set (engine/taut.cmake). The lanes of a vector are the rows of a pack, or x, y, z
// and 0 of one velocity. Every width does the same operations in the same order.
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

// x, y and z of four rows.
struct Vectors {
    Lanes x, y, z;
};
inline Lanes dot(const Vectors& a, const Vectors& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vectors load(const Four* from) {
    return {load(from[0]), load(from[1]), load(from[2])};
}

inline Lanes root(Lanes square) {
    for (int k = 0; k < 4; ++k) square[k] = __builtin_sqrt(square[k]);
    return square;
}

// The velocities of the rows' first, second, … points.
inline Vectors velocitiesOf(const Pack& pack, int k, const Four* velocities) {
    const Lanes a = load(velocities[pack.slots[0][k]]), b = load(velocities[pack.slots[1][k]]);
    const Lanes c = load(velocities[pack.slots[2][k]]), d = load(velocities[pack.slots[3][k]]);
    const Lanes abEven = __builtin_shufflevector(a, b, 0, 4, 2, 6), abOdd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Lanes cdEven = __builtin_shufflevector(c, d, 0, 4, 2, 6), cdOdd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return {__builtin_shufflevector(abEven, cdEven, 0, 1, 4, 5), __builtin_shufflevector(abOdd, cdOdd, 0, 1, 4, 5),
            __builtin_shufflevector(abEven, cdEven, 2, 3, 6, 7)};
}

// Adds what the rows see of the velocities of their levers.
inline void addLevers(const Pack& pack, const Sweeps& batch, const Four* velocities, Vectors& sum) {
    for (int lane = 0; lane < 4; ++lane) {
        for (int k = pack.turns[lane].first; k < pack.turns[lane].last; ++k) {
            const Turn& turn = batch.turns[k];
            const double* spin = velocities[turn.slot].of;
            sum.x[lane] += spin[1] * turn.arm[2] - spin[2] * turn.arm[1];
            sum.y[lane] += spin[2] * turn.arm[0] - spin[0] * turn.arm[2];
            sum.z[lane] += spin[0] * turn.arm[1] - spin[1] * turn.arm[0];
        }
        if (pack.shares[lane].isEmpty()) continue;
        Lanes own{};
        for (int k = pack.shares[lane].first; k < pack.shares[lane].last; ++k)
            own += batch.shares[k].weight * load(velocities[batch.shares[k].slot]);
        sum.x[lane] += own[0];
        sum.y[lane] += own[1];
        sum.z[lane] += own[2];
    }
}
// Changes the velocities of a row's levers by its impulse.
inline void pushLevers(const Pack& pack, int lane, const Lanes& impulse, const Sweeps& batch) {
    for (int k = pack.turns[lane].first; k < pack.turns[lane].last; ++k) {
        const double *arm = batch.turns[k].arm, *gain = batch.turns[k].gain;
        const double moment[3] = {arm[1] * impulse[2] - arm[2] * impulse[1], arm[2] * impulse[0] - arm[0] * impulse[2],
                                  arm[0] * impulse[1] - arm[1] * impulse[0]};
        double* spin = batch.velocities[batch.turns[k].slot].of;
        for (int i = 0; i < 3; ++i)
            spin[i] += gain[3 * i] * moment[0] + gain[3 * i + 1] * moment[1] + gain[3 * i + 2] * moment[2];
    }
    for (int k = pack.shares[lane].first; k < pack.shares[lane].last; ++k) {
        Four& own = batch.velocities[batch.shares[k].slot];
        store(own, load(own) + batch.shares[k].gain * impulse);
    }
}

inline Vectors relativeVelocity(const Pack& pack, const Sweeps& batch, const Four* velocities) {
    Vectors sum;
    for (int k = 0; k < 4; ++k) {
        const Vectors own = velocitiesOf(pack, k, velocities);
        const Lanes weight = load(pack.weights[k]);
        sum = k == 0 ? Vectors{weight * own.x, weight * own.y, weight * own.z}
                     : Vectors{sum.x + weight * own.x, sum.y + weight * own.y, sum.z + weight * own.z};
    }
    if (pack.hasLevers) addLevers(pack, batch, velocities, sum);
    return sum;
}

// Changes the velocities by impulses; rows for which all of it is 0 change nothing.
inline void apply(const Pack& pack, const Lanes (&impulse)[4], const Sweeps& batch) {
    Four* velocities = batch.velocities;
    const Vectors normal = load(pack.normal);
    const Lanes x = impulse[0] + impulse[3] * normal.x, y = impulse[1] + impulse[3] * normal.y,
                z = impulse[2] + impulse[3] * normal.z, none{};
    const Lanes xyEven = __builtin_shufflevector(x, y, 0, 4, 2, 6), xyOdd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Lanes zEven = __builtin_shufflevector(z, none, 0, 4, 2, 6);
    const Lanes zOdd = __builtin_shufflevector(z, none, 1, 5, 3, 7);
    const Lanes rows[4] = {
        __builtin_shufflevector(xyEven, zEven, 0, 1, 4, 5), __builtin_shufflevector(xyOdd, zOdd, 0, 1, 4, 5),
        __builtin_shufflevector(xyEven, zEven, 2, 3, 6, 7), __builtin_shufflevector(xyOdd, zOdd, 2, 3, 6, 7)};
    const auto isNone = (impulse[0] == 0) & (impulse[1] == 0) & (impulse[2] == 0) & (impulse[3] == 0);
    for (int lane = 0; lane < 4; ++lane) {
        if (isNone[lane] != 0) continue;
        for (int k = 0; k < 4; ++k) {
            Four& own = velocities[pack.slots[lane][k]];
            store(own, load(own) + pack.gains[k].of[lane] * rows[lane]);
        }
        if (pack.hasLevers) pushLevers(pack, lane, rows[lane], batch);
    }
}

// Weight of a change of a torque, against one of an impulse, in the test that ends the sweeps. Friction and torque
// converge slowly against each other, and a body at rest would creep.
constexpr double finerForRolls = 1e3;

// Calls each(lane, roll).
template <class Each>
inline void forEachRoll(const Pack& pack, const Sweeps& batch, const Each& each) {
    for (int lane = 0; pack.rolls && lane < 4; ++lane)
        if (pack.roll[lane] >= 0) each(lane, batch.rolls[pack.roll[lane]]);
}

// [rad/s] The turn of a row's sides on each other.
inline Lanes turnOf(const Pack& pack, int lane, const Roll& roll, const Sweeps& batch) {
    Lanes sum = -load(roll.driven);
    for (int k = pack.turns[lane].first; k < pack.turns[lane].last; ++k)
        sum += batch.turns[k].weight * load(batch.velocities[batch.turns[k].slot]);
    return sum;
}
// Changes the spins of a row by a torque impulse [N m s].
inline void twist(const Pack& pack, int lane, const Lanes& impulse, const Sweeps& batch) {
    for (int k = pack.turns[lane].first; k < pack.turns[lane].last; ++k) {
        const Turn& turn = batch.turns[k];
        double* spin = batch.velocities[turn.slot].of;
        for (int i = 0; i < 3; ++i)
            spin[i] += turn.weight * (turn.gain[3 * i] * impulse[0] + turn.gain[3 * i + 1] * impulse[1] +
                                      turn.gain[3 * i + 2] * impulse[2]);
    }
}
inline double dotOf(const Lanes& a, const Lanes& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Solves the torques of the rows against turns. Returns the largest squared change of a velocity [(m/s)²].
inline double visitRolls(const Pack& pack, const Sweeps& batch) {
    double largest = 0;
    forEachRoll(pack, batch, [&](int lane, Roll& roll) {
        const double pressing = pack.impulse[3].of[lane];
        const Lanes normal{pack.normal[0].of[lane], pack.normal[1].of[lane], pack.normal[2].of[lane], 0};
        const Lanes before = load(roll.impulse);
        const Lanes turn = turnOf(pack, lane, roll, batch);
        const double spun = dotOf(normal, before), spinning = dotOf(normal, turn);
        const double limit = roll.friction.rolling * pressing, mostSpin = roll.friction.spin * pressing;
        double spin = spun - roll.about * spinning;
        spin = spin > mostSpin ? mostSpin : spin < -mostSpin ? -mostSpin : spin;
        Lanes rolling = before - spun * normal - roll.across * (turn - spinning * normal);
        const double square = dotOf(rolling, rolling);
        if (square > limit * limit) rolling = (limit / __builtin_sqrt(square)) * rolling;
        const Lanes next = rolling + spin * normal, change = next - before;
        store(roll.impulse, next);
        twist(pack, lane, change, batch);
        const double gain = finerForRolls * roll.reach / roll.across, own = gain * gain * dotOf(change, change);
        largest = own > largest ? own : largest;
    });
    return largest;
}

// Solves the rows for the current velocities: first the normal impulse, then friction.
inline void visit(Pack& pack, const Sweeps& batch) {
    const Lanes none{}, mass = load(pack.mass), grip = load(pack.grip), friction = load(pack.friction);
    const Vectors normal = load(pack.normal), velocity = relativeVelocity(pack, batch, batch.velocities);
    const Lanes before[4] = {load(pack.impulse[0]), load(pack.impulse[1]), load(pack.impulse[2]),
                             load(pack.impulse[3])};
    const Lanes parting = dot(normal, velocity);
    const Lanes wanted = before[3] - mass * (parting + load(pack.closing) + load(pack.softness) * before[3]);
    const Lanes least = load(pack.least), pressing = wanted > least ? wanted : least;
    // Coulomb's friction: in the disk around 0.
    Vectors next{before[0] - grip * (velocity.x - parting * normal.x),
                 before[1] - grip * (velocity.y - parting * normal.y),
                 before[2] - grip * (velocity.z - parting * normal.z)};
    const Lanes limit = friction * pressing, square = dot(next, next);
    const auto isBeyond = square > limit * limit, slides = friction > none;
    const Lanes share = isBeyond ? limit / root(square) : none + 1.0;
    next = {slides ? next.x * share : none, slides ? next.y * share : none, slides ? next.z * share : none};
    const Lanes change[4] = {next.x - before[0], next.y - before[1], next.z - before[2], pressing - before[3]};
    store(pack.impulse[0], next.x);
    store(pack.impulse[1], next.y);
    store(pack.impulse[2], next.z);
    store(pack.impulse[3], pressing);
    for (int k = 0; k < 4; ++k) store(pack.change[k], change[k]);
    apply(pack, change, batch);
}

inline double sumOf(const Sweeps& batch) {
    double sum = 0;
    for (int r = 0; r < batch.rowCount; ++r) sum += batch.perRow[r];
    return sum;
}
inline void storePerRow(const Sweeps& batch, const Pack& pack, const Lanes& values) {
    for (int lane = 0; lane < 4; ++lane) batch.perRow[pack.rows[lane]] = values[lane];
}

// λ · (W u + closing + softness share λ), the slope of the energy along the impulses, of which a share is applied.
inline double slope(const Sweeps& batch, double share) {
    for (int p = 0; p < batch.packCount; ++p) {
        const Pack& pack = batch.packs[p];
        const Vectors velocity = relativeVelocity(pack, batch, batch.velocities);
        const Lanes yielding = load(pack.closing) + load(pack.softness) * (share * load(pack.impulse[3]));
        storePerRow(
            batch, pack,
            load(pack.impulse[3]) * (dot(load(pack.normal), velocity) + yielding) + dot(load(pack.impulse), velocity));
        forEachRoll(pack, batch, [&](int lane, const Roll& roll) {
            batch.perRow[pack.rows[lane]] += dotOf(load(roll.impulse), turnOf(pack, lane, roll, batch));
        });
    }
    return sumOf(batch);
}

// Begins a step: what is left of the gaps, and the impulses of the step before.
inline void startStep(const Sweeps& batch) {
    const Lanes none{};
    for (int p = 0; p < batch.packCount; ++p) {
        Pack& pack = batch.packs[p];
        const Lanes gap = load(pack.gap) + dot(load(pack.normal), relativeVelocity(pack, batch, batch.gone));
        store(pack.closing, load(pack.base) + (gap > none ? batch.perSecond * gap : none));
        Lanes impulse[4];
        for (int k = 0; k < 4; ++k) impulse[k] = load(pack.impulse[k]);
        apply(pack, impulse, batch);
    }
}

// Applies the impulses that the rows have, times what makes the energy least.
inline void start(const Sweeps& batch) {
    bool isCold = true;
    for (int p = 0; p < batch.packCount; ++p)
        for (const Four& part : batch.packs[p].impulse)
            for (double impulse : part.of) isCold = isCold && impulse == 0;
    if (isCold) return;
    const auto applyAll = [&](double share) {
        for (int p = 0; p < batch.packCount; ++p) {
            const Pack& pack = batch.packs[p];
            const Lanes impulse[4] = {share * load(pack.impulse[0]), share * load(pack.impulse[1]),
                                      share * load(pack.impulse[2]), share * load(pack.impulse[3])};
            apply(pack, impulse, batch);
            forEachRoll(pack, batch,
                        [&](int lane, Roll& roll) { twist(pack, lane, share * load(roll.impulse), batch); });
        }
    };
    const double before = slope(batch, 0);
    applyAll(1);
    const double rise = slope(batch, 1) - before;  // λᵀ A λ
    const double share = before < 0 && rise > 0 ? -before / rise : 0.0;
    applyAll(share - 1);
    for (int p = 0; p < batch.packCount; ++p) {
        for (Four& part : batch.packs[p].impulse) store(part, share * load(part));
        forEachRoll(batch.packs[p], batch, [&](int, Roll& roll) { store(roll.impulse, share * load(roll.impulse)); });
    }
}

}  // namespace

int sweep(const Sweeps& batch) {
    if (batch.start == Start::guessed) start(batch);
    if (batch.start == Start::kept) startStep(batch);
    const bool extrapolates = batch.most > 2;  // the first sweep has no direction yet, the last needs none
    double squareBefore = 0;
    for (int sweep = 1;; ++sweep) {
        // A sweep. It records the largest squared change of a velocity [(m/s)²], and the squared changes of impulses
        // [(N s)²].
        Lanes largest{};
        for (int p = 0; p < batch.packCount; ++p) {
            Pack& pack = batch.packs[p];
            visit(pack, batch);
            const Vectors change = load(pack.change);
            const Lanes own = dot(change, change) + load(pack.change[3]) * load(pack.change[3]);
            const Lanes gain = load(pack.largestGain), fastest = gain * gain * own;
            largest = fastest > largest ? fastest : largest;
            if (extrapolates) storePerRow(batch, pack, own);
            const double turned = visitRolls(pack, batch);
            largest[0] = turned > largest[0] ? turned : largest[0];
        }
        bool isSettled = true;
        for (int lane = 0; lane < 4; ++lane) isSettled = isSettled && largest[lane] < batch.tolerance * batch.tolerance;
        if (sweep == batch.most || isSettled) return sweep;
        if (!extrapolates) continue;

        // How far to extrapolate, after Fletcher and Reeves. If the changes grow, the direction starts anew.
        const double square = sumOf(batch), share = squareBefore > 0 ? square / squareBefore : 0.0;
        squareBefore = square;
        if (share > 1.0) {
            for (int p = 0; p < batch.packCount; ++p)
                for (Four& part : batch.packs[p].direction) part = Four{};
            continue;
        }

        // The extrapolation. If it goes too far, the next sweep clamps it.
        for (int p = 0; p < batch.packCount; ++p) {
            Pack& pack = batch.packs[p];
            Lanes step[4];
            for (int k = 0; k < 4; ++k) {
                step[k] = share * load(pack.direction[k]);
                store(pack.direction[k], step[k] + load(pack.change[k]));
                store(pack.impulse[k], load(pack.impulse[k]) + step[k]);
            }
            apply(pack, step, batch);
        }
    }
}

}  // namespace taut::contact::TAUT_ISA
