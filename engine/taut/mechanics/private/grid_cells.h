// Which cells of a grid of cloth there are, and how many lie at its points and edges. It knows no material.
#pragma once

namespace taut::mechanics {

// All of a rectangle; of a round cloth those of which the middle lies in the ellipse that fits into it.
struct GridCells {
    int columns = 0, rows = 0;
    bool isRound = false;

    bool has(int i, int j) const {
        if (i < 0 || i >= columns || j < 0 || j >= rows) return false;
        const double u = (2 * i + 1.0) / columns - 1, v = (2 * j + 1.0) / rows - 1;
        return !isRound || u * u + v * v <= 1;
    }
    // At a point: 0 to 4.
    int around(int i, int j) const { return beside(i - 1, j, 1, 0) + beside(i, j, 1, 0); }
    // Along the edge that leads from a point a column (1, 0) or a row (0, 1) on: 0 to 2.
    int beside(int i, int j, int di, int dj) const { return has(i, j) + has(i - dj, j - di); }
};

}  // namespace taut::mechanics
