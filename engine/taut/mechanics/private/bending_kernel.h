// Forces of a grid's folds and twists, see Bending in model.h. It knows no generator. There is one copy for each
// instruction set.
#pragma once

namespace taut::mechanics {

template <class Real>
struct BendingBatch {
    int columns, rows;                          // of the whole grid
    int first, last;                            // rows that get forces: first … last - 1
    const Real *along, *across, *both, *twist;  // (columns · rows) [N/m]; no `both` where all are 0, no `twist` with
    Real evenTwist;                             // that of every cell [N/m]; 0 where `twist` has each
    const Real* x[3];                           // (columns · rows) [m]
    Real* f[3];                                 // (columns · rows) [N]; the kernel adds minus the gradient
    Real* room;                                 // bendingRoom(columns)
};

// The distance between rows of moments: one more number on each side, rounded up to whole vectors.
inline int bendingPitch(int columns) {
    return (columns + 2 * 16 + 15) / 16 * 16;
}
inline int bendingRoom(int columns) {
    return 27 * bendingPitch(columns);
}

}  // namespace taut::mechanics
