// The inner loops of the spring forces. There is one copy for each instruction set, and every copy gives the same bits.
#pragma once

namespace taut::mechanics {

// Forces live in a window of three planes, points of the network in three planes of another stride.

// Springs alike: spring i joins points a + i and a + i + offset.
template <class Real>
struct SpringRun {
    int a;       // first point
    int offset;  // > 0
    int count;
    int together;          // runs from this one on that begin at the same point and are as long; 0 within such a bundle
    int table;             // where its stiffnesses begin in a table of them [N/m]
    Real restLength, tau;  // of all its springs [m], damping time [s] …
    int mixed;             // … if < 0; else where their rest lengths begin in another, followed by their taus
};
inline constexpr int mostTogether = 8;

// A bundle: runs that begin at the same point and have the same number of springs.
template <class Real>
struct SpringBundleArgs {
    const SpringRun<Real>* runs;  // (runs->together), 1 … mostTogether
    const Real* stiffness;        // the tables that they name
    const Real* mixed;
    int stride;        // of x and v
    int windowStride;  // of f
    const Real* x;     // planes at the runs' first point a [m]
    const Real* v;     // planes at a [m/s]
    Real* f;           // planes at a, added to [N]
};

// n springs between any points.
template <class Real>
struct SpringListArgs {
    int n;
    int stride;
    int windowStride;
    int windowFirst;         // point at the window's start
    const Real* x;           // planes from point 0
    const Real* v;           // planes from point 0
    Real* f;                 // planes of the window
    const int* a;            // (n)
    const int* b;            // (n)
    const Real* k;           // (n) [N/m]
    const Real* restLength;  // (n) [m]
    const Real* tau;         // (n) [s]
};

// Points packed one by one instead of in planes, for springs that jump between them: x y z 0 u v w 0, and for forces x
// y z 0.
inline constexpr int packedState = 8, packedForce = 4;

// n springs between any points of a packed window.
template <class Real>
struct PackedSpringArgs {
    int n;
    int windowFirst;         // point at the window's start
    const Real* state;       // (window · packedState)
    Real* f;                 // (window · packedForce) [N]
    const int* a;            // (n)
    const int* b;            // (n)
    const Real* k;           // (n) [N/m]
    const Real* restLength;  // (n) [m]
    const Real* tau;         // (n) [s]
};

// Packs x and v of n points, and sets their packed forces to zero.
template <class Real>
struct PackArgs {
    int n;
    int stride;
    const Real* x;  // planes
    const Real* v;  // planes
    Real* state;
    Real* f;
};

// Adds packed forces of n points to a window's planes.
template <class Real>
struct UnpackArgs {
    int n;
    const Real* packed;
    Real* f;
    int windowStride;
};

// From forces to accelerations of n points: a = (f + external)/m + uniform for free points, 0 for held ones.
template <class Real>
struct AccelerationArgs {
    int n;
    const Real* inverseMass;  // (n) [1/kg], 0 if held
    Real uniform[3];          // [m/s²]
    const Real* external;     // planes [N], or nullptr
    int externalStride;
    Real* f;  // planes, from forces [N] to accelerations [m/s²]
    int windowStride;
};

template <class Real>
struct SpringKernels {
    void (*bundle)(const SpringBundleArgs<Real>&);
    void (*list)(const SpringListArgs<Real>&);
    void (*packedList)(const PackedSpringArgs<Real>&);
    void (*pack)(const PackArgs<Real>&);
    void (*unpack)(const UnpackArgs<Real>&);
    void (*accelerate)(const AccelerationArgs<Real>&);
};

// For the instruction set in use.
template <class Real>
SpringKernels<Real> springKernels();

}  // namespace taut::mechanics
