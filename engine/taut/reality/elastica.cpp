#include "taut/reality/elastica.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/bisect.h"
#include "taut/core/trig.h"

namespace taut::reality {
namespace {

using core::pi;

using State = std::array<double, 4>;  // δ, δ', down, across

State slopeOf(const ElasticaEnd& end, double sigma, const State& y) {
    const double s = std::sin(y[0]), c = std::cos(y[0]);
    return {y[1], (end.load + end.weight * sigma) * s - end.across * c, c, s};
}

State moved(const State& y, double h, const State& slope) {
    State out = y;
    for (std::size_t i = 0; i < y.size(); ++i) out[i] += h * slope[i];
    return out;
}

}  // namespace

ElasticaPoint elasticaAt(const ElasticaEnd& end, double length) {
    constexpr int steps = 1000;
    const double h = length / steps;
    State y{end.angle, end.curvature, 0, 0};
    double widest = 0, mostAngle = end.angle;
    for (int i = 0; i < steps; ++i) {
        const double sigma = h * i;
        const State a = slopeOf(end, sigma, y), b = slopeOf(end, sigma + h / 2, moved(y, h / 2, a)),
                    c = slopeOf(end, sigma + h / 2, moved(y, h / 2, b)), d = slopeOf(end, sigma + h, moved(y, h, c));
        for (std::size_t k = 0; k < y.size(); ++k) y[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
        widest = std::max(widest, std::abs(y[3]));
        mostAngle = std::max(mostAngle, y[0]);
    }
    return {y[0], y[1], y[2], y[3], widest, mostAngle};
}

// The free end of a long strip points down but for e^(-⅔ √Γ): its logarithm is well determined by the clamp's angle.
// The larger it is, the sooner the strip turns to the clamp's direction, and then beyond.
HangingStrip hangingStrip(double weight, double load, double clampAngle) {
    const auto clampOf = [&](double logAngle) {
        return elasticaAt({.angle = std::exp(logAngle), .load = load, .weight = weight});
    };
    const double angle = core::rootOf([&](double u) { return clampAngle - clampOf(u).mostAngle; }, -80.0,
                                      std::log(clampAngle * (1 - 1e-9)), 100);
    const ElasticaPoint clamp = clampOf(angle);
    return {clamp.down, clamp.across, std::exp(angle)};
}

double elasticaDroop(double weight) {
    const HangingStrip strip = hangingStrip(weight, 0, pi / 2);
    return strip.down / strip.out;
}

// At the least Γ at which a strip leans by itself, one whose free end leans by next to nothing has an upright foot.
double standingWeight() {
    constexpr double lean = 1e-6;
    return core::rootOf([&](double weight) { return pi - elasticaAt({.angle = pi - lean, .weight = weight}).angle; },
                        1.0, 20.0, 100);
}

// Half of it, from its lowest point, where it is level, has the unknown curvature κ and pulls with N across. A
// weightless ring is a circle; from there the weight and the angle that the half turns by change bit by bit, so that
// Newton's method starts near.
Loop loopOf(LoopKind kind, double weight) {
    const double turn = kind == LoopKind::ring ? pi : kind == LoopKind::heart ? 1.5 * pi : 0.5 * pi;
    double curvature = -2 * pi, across = 0;
    ElasticaPoint clamp;
    constexpr int stages = 20;
    for (int stage = 0; stage <= stages; ++stage) {
        const double share = static_cast<double>(stage) / stages, turned = pi + share * (turn - pi);
        const auto half = [&](double k, double n) { return elasticaAt({pi / 2, k, 0, n, share * weight}, 0.5); };
        for (int step = 0; step < 5; ++step) {
            constexpr double d = 1e-6;
            const ElasticaPoint now = half(curvature, across), byK = half(curvature + d, across),
                                byN = half(curvature, across + d);
            const double angleOff = now.angle - (pi / 2 - turned), beside = now.across;
            const double a = (byK.angle - now.angle) / d, b = (byN.angle - now.angle) / d,
                         c = (byK.across - now.across) / d, e = (byN.across - now.across) / d, det = a * e - b * c;
            curvature -= (angleOff * e - beside * b) / det;
            across -= (a * beside - c * angleOff) / det;
        }
        clamp = half(curvature, across);
    }
    return {clamp.down, 2 * clamp.widest};
}

// Seen along the push on its free end the rod is the same for every friction: that is in the angle of the clamp. Of the
// loads at which the clamp lies straight behind the free end the least is that of the first buckling, 20.19 B/L² where
// the rod is straight.
PushedRod pushedRod(double endAngle) {
    const auto clampOf = [&](double thrust) { return elasticaAt({.angle = endAngle, .load = -thrust}); };
    const auto beside = [](const ElasticaPoint& at) {
        return at.across * std::cos(at.angle) - at.down * std::sin(at.angle);
    };
    const double thrust = core::rootOf([&](double t) { return beside(clampOf(t)); }, 12.0, 60.0, 45);
    const ElasticaPoint clamp = clampOf(thrust);
    const double c = std::cos(clamp.angle), s = std::sin(clamp.angle);
    return {1 - (clamp.down * c + clamp.across * s), std::abs(std::tan(clamp.angle)), thrust * c};
}

PushedRod pushedRodAt(double friction) {
    const double angle = core::rootOf([&](double a) { return friction - pushedRod(a).friction; }, 0.01, 1.4, 40);
    return pushedRod(angle);
}

Column columnOf(double endSlope) {
    const double k = std::sin(endSlope / 2), first = std::comp_ellint_1(k), second = std::comp_ellint_2(k);
    return {2 - 2 * second / first, k / first, 4 * first * first};
}

}  // namespace taut::reality
