// Euler's elastica, heavy or not, by shooting from its free end: the theory of bent strips and rods. Independent of
// grids and of the engine's forces.
#pragma once

namespace taut::reality {

// A strip of length 1 and rigidity 1, so that forces are in B/L² and weights in B/L³ (Γ = wL³/B). At the arc length σ
// from its free end its tangent, towards that end, makes the angle δ with the direction in which its weight pulls:
//
//     δ'' = (P + Γσ) sin δ - N cos δ                P, N: the load on the free end along and across the weight
struct ElasticaEnd {
    double angle = 0;             // δ at σ = 0 [rad]
    double curvature = 0;         // δ' at σ = 0, in 1/L
    double load = 0, across = 0;  // P, N in B/L²
    double weight = 0;            // Γ
};
struct ElasticaPoint {
    double angle = 0, curvature = 0;  // δ, δ' there
    double down = 0, across = 0;      // the free end as seen from there, along and across the weight, in L
    double widest = 0;                // largest |across| on the way, seen from the free end
    double mostAngle = 0;             // largest δ on the way
};
// Runge and Kutta's method of order 4 over so much of the length, in 1000 steps.
ElasticaPoint elasticaAt(const ElasticaEnd& end, double length = 1);

// A strip that is clamped at one end, under its weight and a load P on the other end: where that end is, seen from the
// clamp. The clamp points at such an angle from the weight's direction: π/2 level, π upright. An upright one is the
// buckled shape, not the straight one; expects a weight beyond standingWeight().
struct HangingStrip {
    double down = 0, out = 0;  // of the free end, below and beside the clamp, in L
    double endAngle = 0;       // of the free end from the weight's direction [rad]
};
HangingStrip hangingStrip(double weight, double load, double clampAngle);

// Height over width of one that is clamped level and bears nothing else, H/W at Γ.
double elasticaDroop(double weight);

// Γ at which an upright strip buckles (Greenhill 1881).
double standingWeight();

// A strip whose ends are clamped side by side (Peirce 1930). ring: level; heart: upwards; pear: downwards.
enum class LoopKind { ring, heart, pear };
struct Loop {
    double height = 0, width = 0;  // of its lowest point below the clamp; of its widest place, in L
};
Loop loopOf(LoopKind kind, double weight);

// A rod clamped upright over a plane on which its lower end rests straight below, weightless, once the clamp has come
// down (Sano, Yamaguchi and Wada 2017): it slips where friction is less than `friction`.
struct PushedRod {
    double lowering = 0;  // of the clamp, in L
    double friction = 0;  // tangential over normal force
    double thrust = 0;    // normal force in B/L²
};
PushedRod pushedRod(double endAngle);    // of the lower end from the push on it [rad], 0.01 … 1.2
PushedRod pushedRodAt(double friction);  // 0.01 … 0.3

// A weightless strip with hinged ends that are pushed together, whose end slope is given [rad] (elliptic integrals).
struct Column {
    double shortening = 0, crest = 0;  // in L
    double thrust = 0;                 // in B/L²
};
Column columnOf(double endSlope);

}  // namespace taut::reality
