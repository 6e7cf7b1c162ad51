// Weighted sums over packed points, for elements that bend. It knows no element. There is one copy for each instruction
// set, with the same bits.
#pragma once

namespace taut::mechanics {

template <class Real>
struct WeightedPoint {
    int from;
    Real weight;
};

// Rows of weighted points: row i has the entries first[i] … first[i + 1] - 1. A packed vector is x y z 0.
template <class Real>
struct WeightedRows {
    const int* first;
    const WeightedPoint<Real>* entries;
    const Real* vectors;  // (4 · vectors)
};

// Adds scale · (Σ g_ij (x_j - x_i) + Σ w_ik p_k) to the planes of points[i], for rows begin … end - 1.
template <class Real>
struct CouplingBatch {
    WeightedRows<Real> couplings, pulls;
    int begin, end;
    const int* points;
    Real scale;
    long stride;
    Real* out;
};
// To sums (4 · rows) Σ w_ij (x_j - x_i0), where x_i0 is the first of the row, for rows begin … end - 1.
template <class Real>
struct SumBatch {
    WeightedRows<Real> rows;
    int begin, end;
    Real* sums;
};

// The same sums y, with `held` (4 · rows) added if it is not null, and from them four vectors a row to pulls (16 ·
// rows): the unit normal n of the triangle of three corners, and -(g_i·y) n of each, where g_i are the gradients of its
// hat functions. Where the first corner is -1, n is the direction of y, and the others are 0. n is 0 where it is not
// defined.
template <class Real>
struct PullBatch {
    WeightedRows<Real> rows;
    int begin, end;
    const int* corners;  // (3 · rows)
    const Real* held;
    Real* pulls;
};

template <class Real>
struct ElementKernels {
    void (*couplings)(const CouplingBatch<Real>&);
    void (*sums)(const SumBatch<Real>&);
    void (*pulls)(const PullBatch<Real>&);
};

}  // namespace taut::mechanics
