#include "taut/mechanics/bending.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/mechanics/private/grid_cells.h"

namespace taut::mechanics {

double leastBias(double warp, double weft) {
    const double difference = std::sqrt(warp) - std::sqrt(weft);
    return 0.25 * difference * difference;
}

double rigidityAt(const BendingRigidity& rigidity, double angle) {
    const double cc = core::cosine(angle) * core::cosine(angle), ss = 1.0 - cc;
    return rigidity.along * cc * cc + rigidity.across * ss * ss + (2.0 * rigidity.both + rigidity.twist) * cc * ss;
}

std::optional<BendingRigidity> orthotropicRigidity(double warp, double weft, std::optional<double> bias) {
    TAUT_EXPECTS(warp >= 0 && weft >= 0);
    const double mean = std::sqrt(warp * weft);
    if (!bias) return BendingRigidity{warp, weft, 0, 2 * mean};
    if (!(*bias > leastBias(warp, weft))) return std::nullopt;
    const double rest = 4 * *bias - warp - weft;  // 2 B_1 + 4 D_k > -2 mean
    if (rest > 0) return BendingRigidity{warp, weft, 0, rest};
    const double twice = 0.5 * (rest - 2 * mean);  // 2 B_1
    return BendingRigidity{warp, weft, 0.5 * twice, rest - twice};
}

// The area of a cell has x_uu = d/a² and so on. Folds along an edge of the grid have half the width.
Bending gridBending(int columns, int rows, const BendingRigidity& rigidity, double a, double b, bool isRound) {
    const GridCells cells{columns - 1, rows - 1, isRound};
    Bending bending;
    bending.columns = columns;
    bending.rows = rows;
    const auto size = static_cast<std::size_t>(columns * rows);
    for (auto* list : {&bending.along, &bending.across, &bending.both, &bending.twist}) list->assign(size, 0.0);
    const double along = rigidity.along * b / (a * a * a), across = rigidity.across * a / (b * b * b),
                 both = rigidity.both / (a * b), twist = rigidity.twist / (a * b);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto own = static_cast<std::size_t>(j * columns + i);
            bending.along[own] = along * std::min(cells.beside(i - 1, j, 1, 0), cells.beside(i, j, 1, 0)) / 2.0;
            bending.across[own] = across * std::min(cells.beside(i, j - 1, 0, 1), cells.beside(i, j, 0, 1)) / 2.0;
            if (cells.around(i, j) == 4) bending.both[own] = both;
            if (cells.has(i, j)) bending.twist[own] = twist;
        }
    return bending;
}

Bending lineBending(int points, double rigidity, double a) {
    Bending bending;
    bending.columns = points;
    bending.rows = 1;
    const auto size = static_cast<std::size_t>(points);
    for (auto* list : {&bending.along, &bending.across, &bending.both, &bending.twist}) list->assign(size, 0.0);
    for (std::size_t i = 1; i + 1 < size; ++i) bending.along[i] = rigidity / (a * a * a);
    return bending;
}

Bending clamped(Bending bending, const std::vector<bool>& isHeld, const std::vector<bool>& isClamped,
                std::span<const glm::dvec3> rest) {
    const int n = bending.columns;
    const std::vector<double> alongs = bending.along, acrosses = bending.across;
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    // Changes the fold of one direction at point i. Its neighbours are `step` apart; hasBefore and hasAfter say whether
    // they exist. `whole` is the stiffness of a whole fold in this line.
    const auto visit = [&](std::vector<double>& folds, int i, int step, bool hasBefore, bool hasAfter, double whole) {
        double& fold = folds[at(i)];
        if (isClamped[at(i)]) {
            for (const int next : {i - step, i + step})
                if ((next < i ? hasBefore : hasAfter) && !isHeld[at(next)])
                    bending.clamps.push_back({i, next, rest[at(next)] - rest[at(i)], 2 * whole});
            fold = 0;
            bending.both[at(i)] = 0;
        } else if (isHeld[at(i)] && hasBefore && hasAfter && isHeld[at(i - step)] != isHeld[at(i + step)]) {
            fold *= 2;
        }
    };
    // Points inside a line have the line's stiffness.
    std::vector<double> along(at(bending.rows)), across(at(n));
    for (int i = 0; i < n * bending.rows; ++i) {
        along[at(i / n)] = std::max(along[at(i / n)], alongs[at(i)]);
        across[at(i % n)] = std::max(across[at(i % n)], acrosses[at(i)]);
    }
    for (int i = 0; i < n * bending.rows; ++i) {
        if (!isHeld[at(i)]) continue;
        const int column = i % n, row = i / n;
        visit(bending.along, i, 1, column > 0, column < n - 1, along[at(row)]);
        visit(bending.across, i, n, row > 0, row < bending.rows - 1, across[at(column)]);
    }
    return bending;
}

}  // namespace taut::mechanics
