// The force of moving air on triangles, in batches. It knows no generator. There is one copy for each instruction set.
#pragma once

#include "taut/mechanics/private/kernel_parts.h"

namespace taut::mechanics {

inline constexpr int gustWaveCount = 6;

// wave(θ) = r (w0 + w1 r² + w2 r⁴) with r = θ - nearest whole: a sine of one turn, up to a few per cent. It is 1 at a
// quarter turn. The second derivative vanishes at r = ½, so value, slope and curvature are continuous between turns.
inline constexpr double gustWaveShape[3] = {448.0 / 75.0, -2560.0 / 75.0, 3072.0 / 75.0};

// A gust field at one instant: g = Σ strength · wave(wavenumber · x + phase), then bent below its limit.
template <class Real>
struct GustWaves {
    Real wavenumber[3][gustWaveCount];  // [turns/m]
    Real phase[gustWaveCount];          // [turns], -½ … ½
    Real strength[3][gustWaveCount];    // [m/s]
    Real inverseLimitSquared;           // 1/limit² [s²/m²]
};

// Wind on triangles. With gusts the kernel first computes the points' velocities less the gust -> `slip`.
template <class Real>
struct WindBatch {
    CornerLanes<3> lanes;
    const Real* weight;  // (lanes) 1, or 0 for a lane without a triangle
    int stride;
    const Real* x;                // (3 · stride) [m]
    const Real* v;                // (3 · stride) [m/s]
    Real* f;                      // (3 · stride) [N]; the kernel adds to it
    Real flow[3];                 // steady part of the air's velocity [m/s]
    Real drag, lift;              // ρ C_D / 12, ρ C_L / 12 [kg/m³]
    const GustWaves<Real>* gust;  // null: steady
    int firstPoint, pointCount;   // the range that has all points of the triangles
    Real* slip;                   // (3 · pointCount) scratch for the velocities of the points less the gust there
    Real* packed;                 // (12 · loosePointCount) scratch for x, slip and forces of points of loose triangles
};

}  // namespace taut::mechanics
