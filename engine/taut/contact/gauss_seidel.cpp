#include "taut/contact/gauss_seidel.h"

#include <algorithm>
#include <vector>

#include "taut/core/private/instruction_set.h"

namespace taut::contact {

TAUT_KERNELS(int sweep(const Sweeps&);)

namespace {

struct Scratch {
    std::vector<int> heights;  // (slots) levels that have it so far
    std::vector<int> levels;   // (rows)
    std::vector<int> next;     // (levels + 1) place of its next row, four to a pack
    std::vector<Pack> packs;
    std::vector<double> perRow;
};

// The level of each row -> levels. Returns how many there are.
int findLevels(std::span<const Row> rows, std::size_t slotCount, std::span<const Share> shares, Scratch& scratch) {
    scratch.heights.resize(std::max(scratch.heights.size(), slotCount), 0);
    scratch.levels.clear();
    // A spin is in a row together with the velocity of its body.
    const auto forEachSlot = [&](const Row& row, auto&& each) {
        for (int s : row.slots) each(scratch.heights[static_cast<std::size_t>(s)]);
        for (int k = row.shares.first; k < row.shares.last; ++k)
            each(scratch.heights[static_cast<std::size_t>(shares[static_cast<std::size_t>(k)].slot)]);
    };
    int count = 0;
    for (const Row& row : rows) {
        int level = 0;
        forEachSlot(
            row, [&](int height) { level = std::max(level, height); });
        forEachSlot(row, [&](int& height) { height = level + 1; });
        scratch.levels.push_back(level);
        count = std::max(count, level + 1);
    }
    for (const Row& row : rows) forEachSlot(row, [](int& height) { height = 0; });
    return count;
}

void putInto(Pack& pack, int lane, const Row& row, double gap, int number) {
    for (int k = 0; k < 4; ++k) {
        if (k < 3) pack.normal[k].of[lane] = row.normal.of[k];
        pack.impulse[k].of[lane] = row.impulse.of[k];
        pack.weights[k].of[lane] = row.weights[k];
        pack.gains[k].of[lane] = row.gains[k];
        pack.slots[lane][k] = row.slots[k];
    }
    pack.mass.of[lane] = row.mass;
    pack.grip.of[lane] = row.grip > 0 ? row.grip : row.mass;
    pack.turns[lane] = row.turns;
    pack.shares[lane] = row.shares;
    pack.roll[lane] = row.roll;
    pack.rolls = pack.rolls || row.roll >= 0;
    pack.hasLevers = pack.hasLevers || !row.turns.isEmpty() || !row.shares.isEmpty();
    pack.closing.of[lane] = row.closing;
    pack.friction.of[lane] = row.friction;
    pack.softness.of[lane] = row.softness;
    pack.least.of[lane] = row.least;
    pack.largestGain.of[lane] = row.largestGain;
    pack.gap.of[lane] = gap;
    pack.base.of[lane] = row.closing;
    pack.rows[lane] = number;
}

// Rows in packs, level by level. gaps: none, or (rows) [m].
void packInto(std::vector<Pack>& packs, std::span<const Row> rows, std::span<const double> gaps, std::size_t slotCount,
              const Levers& levers, Scratch& scratch) {
    const int count = static_cast<int>(rows.size());
    const int levels = findLevels(rows, slotCount, levers.shares, scratch);
    // How many packs each level has, and where its packs begin.
    std::vector<int>& next = scratch.next;
    next.assign(static_cast<std::size_t>(levels) + 1, 0);
    for (int level : scratch.levels) ++next[static_cast<std::size_t>(level)];
    int packCount = 0;
    for (int& own : next) {
        const int inLevel = (own + 3) / 4;
        own = 4 * packCount;
        packCount += inLevel;
    }
    packs.assign(static_cast<std::size_t>(packCount), Pack{});
    for (int r = 0; r < count; ++r) {
        const auto number = static_cast<std::size_t>(r);
        const Row& row = rows[number];
        const int place = next[static_cast<std::size_t>(scratch.levels[number])]++;
        Pack& pack = packs[static_cast<std::size_t>(place / 4)];
        if (place % 4 == 0)
            for (int lane = 1; lane < 4; ++lane) {
                std::copy(std::begin(row.slots), std::end(row.slots), pack.slots[lane]);
                pack.rows[lane] = count;
            }
        putInto(pack, place % 4, row, gaps.empty() ? 0.0 : gaps[number], r);
    }
}

void readImpulses(std::span<const Pack> packs, std::span<Row> rows) {
    const int count = static_cast<int>(rows.size());
    for (const Pack& pack : packs)
        for (int lane = 0; lane < 4; ++lane)
            if (pack.rows[lane] < count)
                for (int k = 0; k < 4; ++k)
                    rows[static_cast<std::size_t>(pack.rows[lane])].impulse.of[k] = pack.impulse[k].of[lane];
}

Sweeps batchOf(std::vector<Pack>& packs, int rowCount, std::vector<double>& perRow, int sweeps, double tolerance,
               std::span<Four> velocities, const Levers& levers, Start start) {
    perRow.assign(static_cast<std::size_t>(rowCount) + 1, 0.0);
    return {packs.data(),
            static_cast<int>(packs.size()),
            rowCount,
            perRow.data(),
            velocities.data(),
            levers.turns.data(),
            levers.shares.data(),
            levers.rolls.data(),
            sweeps,
            tolerance,
            start};
}

}  // namespace

int projectedGaussSeidel(std::span<Row> rows, int sweeps, double tolerance, std::span<Four> velocities,
                         const Levers& levers, Start start) {
    thread_local Scratch scratch;
    packInto(scratch.packs, rows, {}, velocities.size(), levers, scratch);
    const int taken = TAUT_IN_USE(sweep)(batchOf(scratch.packs, static_cast<int>(rows.size()), scratch.perRow, sweeps,
                                                 tolerance, velocities, levers, start));
    readImpulses(scratch.packs, rows);
    return taken;
}

void RowPacks::take(std::span<const Row> rows, std::span<const double> gaps, std::size_t slotCount,
                    const Levers& levers) {
    rowCount_ = static_cast<int>(rows.size());
    thread_local Scratch scratch;
    packInto(packs_, rows, gaps, slotCount, levers, scratch);
}

void RowPacks::sweep(int sweeps, double tolerance, double h, std::span<Four> velocities, std::span<const Four> gone,
                     const Levers& levers) {
    Sweeps batch = batchOf(packs_, rowCount_, perRow_, sweeps, tolerance, velocities, levers, Start::kept);
    batch.gone = gone.data();
    batch.perSecond = 1.0 / h;
    TAUT_IN_USE(sweep)(batch);
}

void RowPacks::read(std::span<Row> rows) const {
    readImpulses(packs_, rows);
}

}  // namespace taut::contact
