// From the bending rigidity of a sheet or a rope to the coefficients of its grid of points.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

// From measured values: the rigidity of a sheet that is bent to a cylinder across the warp (u), across the weft (v),
// and at 45° between them, 4 B₄₅ = B_u + B_v + 2 B_1 + 4 D_k. B_1 is 0 if D_k > 0 then; otherwise it is half way to its
// limit -√(B_u B_v). Without a bias it is that of an isotropic sheet with the mean √(B_u B_v). None if no energy is
// positive: at or below leastBias(). Expects warp, weft >= 0.
std::optional<BendingRigidity> orthotropicRigidity(double warp, double weft, std::optional<double> bias);
double leastBias(double warp, double weft);  // (√B_u - √B_v)²/4 [N m]
// Of the sheet bent to a cylinder along a line at an angle [rad] to u [N m].
double rigidityAt(const BendingRigidity& rigidity, double angle);

// Of columns by rows of points, a row's a and a column's b apart [m]. Rows and columns at an edge stand for half a
// cell's width. A round one has the cells that buildCloth() gives a round cloth.
Bending gridBending(int columns, int rows, const BendingRigidity& rigidity, double a, double b, bool isRound = false);
// Of a line of points a apart [m], EI [N m²].
Bending lineBending(int points, double rigidity, double a);

// The same with directions held. A point whose direction is held has no fold: to each neighbour that is not held there
// is a clamp instead, of twice the stiffness, for half its cell bends (the error is then of second order in the cell).
// A fold at a held point between a held and a free neighbour counts twice for the same reason. isHeld, isClamped
// (points); arms between points as they lie at `rest` (points) [m].
Bending clamped(Bending bending, const std::vector<bool>& isHeld, const std::vector<bool>& isClamped,
                std::span<const glm::dvec3> rest);

// The energy of all but the clamps as a sum of ½ coefficient |Σ weight x|², where the weights sum to 0. A coefficient
// may be negative, the sum is not: `both` d·e is a quarter of |d + e|² - |d - e|².
struct BendingTerm {
    int count = 0;
    int points[5] = {};  // of the grid
    double weights[5] = {};
    double coefficient = 0;  // [N/m]
};
template <class Each>
void eachTerm(const Bending& bending, const Each& each) {
    const int n = bending.columns;
    for (int i = 0; i < n * bending.rows; ++i) {
        const auto own = static_cast<std::size_t>(i);
        if (const double c = bending.along[own]; c != 0) each(BendingTerm{3, {i - 1, i, i + 1}, {1, -2, 1}, c});
        if (const double c = bending.across[own]; c != 0) each(BendingTerm{3, {i - n, i, i + n}, {1, -2, 1}, c});
        if (const double c = bending.twist[own]; c != 0)
            each(BendingTerm{4, {i, i + 1, i + n, i + n + 1}, {1, -1, -1, 1}, c});
        if (const double c = 0.5 * bending.both[own]; c != 0) {
            each(BendingTerm{5, {i - 1, i, i + 1, i - n, i + n}, {1, -4, 1, 1, 1}, c});
            each(BendingTerm{4, {i - 1, i + 1, i - n, i + n}, {1, 1, -1, -1}, -c});
        }
    }
}

// Without the folds and twists that go through an edge for which isGone(a, b).
template <class IsGone>
Bending without(Bending bending, const IsGone& isGone) {
    const int n = bending.columns;
    for (int i = 0; i < n * bending.rows; ++i) {
        const auto own = static_cast<std::size_t>(i);
        double &along = bending.along[own], &across = bending.across[own], &twist = bending.twist[own];
        if (along != 0 && (isGone(i - 1, i) || isGone(i, i + 1))) along = 0;
        if (across != 0 && (isGone(i - n, i) || isGone(i, i + n))) across = 0;
        if (along == 0 || across == 0) bending.both[own] = 0;
        if (twist != 0 &&
            (isGone(i, i + 1) || isGone(i, i + n) || isGone(i + 1, i + n + 1) || isGone(i + n, i + n + 1)))
            twist = 0;
    }
    std::erase_if(bending.clamps, [&](const Bending::Clamp& clamp) { return isGone(clamp.held, clamp.next); });
    return bending;
}

}  // namespace taut::mechanics
