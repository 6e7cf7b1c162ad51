// The inner loops of the spring forces, one copy an instruction set; every copy gives the same bits.
#pragma once

namespace taut::mechanics {

// Forces live in a window of three planes, points of the network in three planes of another stride.

// n springs alike: spring i joins points i and i + offset of the planes.
template <class Real>
struct SpringRunArgs {
    int n;
    int offset;        // > 0
    int stride;        // of x and v
    int windowStride;  // of f
    const Real* x;     // planes at the run's first point a [m]
    const Real* v;     // likewise [m/s]
    Real* f;           // likewise, added to [N]
    const Real* k;     // (n) stiffness [N/m]
    Real restLength;   // [m]
    Real tau;          // damping time [s]
    // (n) rest lengths and damping times of springs that are not alike in them; or nullptr.
    const Real* restLengths = nullptr;
    const Real* taus = nullptr;
};

// n springs between any points.
template <class Real>
struct SpringListArgs {
    int n;
    int stride;
    int windowStride;
    int windowFirst;         // point at the window's start
    const Real* x;           // planes from point 0
    const Real* v;           // likewise
    Real* f;                 // planes of the window
    const int* a;            // (n)
    const int* b;            // (n)
    const Real* k;           // (n) [N/m]
    const Real* restLength;  // (n) [m]
    const Real* tau;         // (n) [s]
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
    void (*run)(const SpringRunArgs<Real>&);
    void (*list)(const SpringListArgs<Real>&);
    void (*accelerate)(const AccelerationArgs<Real>&);
};

// For the instruction set in use.
template <class Real>
SpringKernels<Real> springKernels();
template <>
SpringKernels<float> springKernels();
template <>
SpringKernels<double> springKernels();

}  // namespace taut::mechanics
