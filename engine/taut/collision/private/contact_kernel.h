// Contact of a batch of points with one convex solid or one mesh. There is one copy for each instruction set. Every
// copy gives the same bits as resolving the points one by one (resolve.cpp). Plain data only.
#pragma once

#include <cstdint>

#include "taut/collision/closed_shape.h"

namespace taut::collision {

inline constexpr int contactBatch = 64;  // points at most, so that their data stays in the first-level cache

// Length of a row: a batch and one cache line more. Rows that are a page apart would slow each other down.
inline constexpr int contactRow = contactBatch + 8;

// Number of rounds in which a point is tested against all candidates: moved out of one, it may stand in another.
inline constexpr int mostPasses = 4;

class FootFinder;
struct FootRows;
struct ContactLanes;

// The triangles of a mesh.
struct FeetArgs {
    const FootFinder* finder = nullptr;  // nullptr: it is no mesh
    const double* facets = nullptr;      // (12 · triangles) each a Facet (facets.h)
    bool isClosed = false;
    FootRows* rows = nullptr;  // cached data of the points from `first` on
    int first = 0;
    // Finds the feet of the points that are lost. It is called once for a pass over the batch.
    void (*find)(const FeetArgs& args, double thickness, int n, ContactLanes& lanes) = nullptr;
};

struct KernelFrame {
    double rotation[3][3];  // columns
    double position[3];     // [m]
    bool turned;
};

template <class Real>
struct ContactArgs {
    int n;                    // points, at most contactBatch
    const Real* before[3];    // (n) [m] at the start of the step
    Real* x[3];               // (n) [m] at its end
    Real* v[3];               // (n) [m/s]
    const Real* inverseMass;  // (n) [1/kg]; 0: left alone
    const unsigned* mask;     // (n) points whose mask is not `bits` are left alone; nullptr: none are
    unsigned bits;
    bool records;  // whether the caller wants the positions of touched points

    ClosedShape shape;
    FeetArgs feet;
    double normal[3];      // of a half-space, in the world
    double offset;         // [m] of a half-space, in the world
    KernelFrame from, to;  // of the solid, at the start and the end of the step
    bool still;            // from and to are the same
    double thickness;      // [m] to be kept
    double skinPerMetre;   // rounding of a coordinate
    double friction;       // of point and surface [-]
    double restitution;    // [-]
    double h;              // [s]
    double restSpeed;      // [m/s] slower arrivals do not bounce
    double fastest;        // [m/s] limit of the surface's speed
};

// The result of the kernel for a point.
enum class PointOutcome : std::int64_t {
    free,     // nothing: it does not touch
    touched,  // moved it out of the solid
    left      // nothing: its path may lead through the solid
};

// The kernel's results for a batch, and its working data.
struct ContactLanes {
    alignas(64) std::int64_t outcome[contactRow];  // a PointOutcome for each point
    alignas(64) double impulse[contactRow];        // of touched points, as in Contact
    alignas(64) double position[3][contactRow];    //
    alignas(64) double normal[3][contactRow];      //

    alignas(64) double start[3][contactRow];    // of the path, in the world
    alignas(64) double carried[3][contactRow];  // velocity of the surface at `position`
    alignas(64) double end[3][contactRow];
    alignas(64) double v[3][contactRow];
    alignas(64) double localStart[3][contactRow];  // for a moving solid, later the start carried along with it
    alignas(64) double localEnd[3][contactRow];
    alignas(64) double skin[contactRow];
    alignas(64) double distance[contactRow];  // at the end; later the offset of the half-space to end in
    alignas(64) double startDistance[contactRow];
    alignas(64) double startNormal[3][contactRow];
    alignas(64) std::int64_t isMoved[contactRow];  // not 0: by more than rounding

    // Of a mesh.
    alignas(64) double way[contactRow];             // [m²] square of the path's length
    alignas(64) double foot[3][contactRow];         // where the surface is nearest
    alignas(64) std::int64_t triangle[contactRow];  // of the foot
    alignas(64) std::int64_t read[contactRow];      // whose numbers `facet` has; -1: none
    alignas(64) double facet[12][contactRow];       //
    alignas(64) std::int64_t bent[contactRow];      // not 0: not over the middle of a triangle
    // Of a mesh, of all of the batch.
    alignas(64) std::int64_t near[contactRow];    // 0: the point is far from it
    alignas(64) std::int64_t result[contactRow];  // the outcome of all passes
    alignas(64) double sum[contactRow];           // of the impulses
    alignas(64) double last[9][contactRow];       // position, normal and carried of the last touch
};

// Bits of a call's return value: whether any point was touched, or left.
inline constexpr std::int64_t anyTouched = 1;
inline constexpr std::int64_t anyLeft = 2;

// Bits of `outcome` while a kernel works: its intermediate results for a point.
inline constexpr std::int64_t isLive = 4, isNear = 8, needsStart = 16;
inline constexpr std::int64_t isLost = 32;      // its foot on a mesh is not known
inline constexpr std::int64_t isOverFace = 64;  // the foot is inside of `triangle`
inline constexpr std::int64_t hasFoot = 128;    // `foot` is known

}  // namespace taut::collision
