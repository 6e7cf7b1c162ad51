// The inner loops of the spring forces, one copy an instruction set; every copy gives the same bits.
#pragma once

namespace taut::mechanics {

// n springs of one kind: spring i joins points i and i + offset of the planes.
template <class Real>
struct SpringRunArgs {
    int n;
    int offset;       // > 0
    int stride;       // of x, v and fa
    int strideB;      // of fb
    const Real* x;    // planes at the run's first point a [m]
    const Real* v;    // likewise [m/s]
    Real* fa;         // forces at the first point a [N]
    Real* fb;         // forces at the first point b [N]
    const Real* k;    // (n) stiffness [N/m]
    Real restLength;  // [m]
    Real tau;         // damping time [s]
    Real* scratch;    // (3 n) when fa and fb overlap, else nullptr
};

// n springs between any points; fb is fa unless the b sides go elsewhere.
template <class Real>
struct SpringListArgs {
    int n;
    int stride;
    int strideB;
    const Real* x;
    const Real* v;
    Real* fa;              // forces, indexed by a
    Real* fb;              // forces, indexed by b - firstB
    int firstB;
    const int* a;          // (n)
    const int* b;          // (n)
    const Real* k;         // (n) [N/m]
    const Real* restLength;  // (n) [m]
    const Real* tau;       // (n) [s]
};

template <class Real>
struct SpringKernels {
    void (*run)(const SpringRunArgs<Real>&);
    void (*list)(const SpringListArgs<Real>&);
    void (*scale)(int n, const Real* inverseMass, Real* f);  // f[i] *= inverseMass[i]
};

// For the instruction set in use.
template <class Real>
SpringKernels<Real> springKernels();

}  // namespace taut::mechanics
