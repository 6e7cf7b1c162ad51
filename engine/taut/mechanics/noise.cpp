#include "taut/mechanics/private/noise.h"

#include <cmath>

#include "taut/core/private/hash.h"
#include "taut/core/trig.h"

namespace taut::mechanics {
namespace {

// A hashed value in 0 … 1, uniformly distributed, for each seed, wave, quantity and step.
double uniform(std::int64_t seed, int wave, int quantity, std::int64_t step) {
    std::uint64_t z = core::mixed(static_cast<std::uint64_t>(seed));
    z = core::mixed(z ^ static_cast<std::uint64_t>(wave * 16 + quantity));
    z = core::mixed(z ^ static_cast<std::uint64_t>(step));
    return static_cast<double>(z >> 11) * 0x1p-53;
}

// A value in -1 … 1: hashed at whole s, blended in between by 6f⁵ - 15f⁴ + 10f³, so that slope and curvature are zero
// at whole s.
double wander(std::int64_t seed, int wave, int quantity, double s) {
    const double whole = std::floor(s), f = s - whole;
    const auto step = static_cast<std::int64_t>(whole);
    const double a = uniform(seed, wave, quantity, step), b = uniform(seed, wave, quantity, step + 1);
    const double blend = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    return 2.0 * (a + (b - a) * blend) - 1.0;
}

// With six waves of rms 0.7 and strengths of rms 0.5, the sum's components have an rms of 0.8 · gain · amplitude.
constexpr double gain = 0.8;

}  // namespace

template <class Real>
GustWaves<Real> gustWaves(const GustField& field, double t) {
    GustWaves<Real> waves{};
    if (!(field.amplitude > 0.0)) return waves;
    const std::int64_t seed = field.seed;
    for (int w = 0; w < gustWaveCount; ++w) {
        // A direction uniform on the sphere, from its height and its angle about y.
        const double height = 2.0 * uniform(seed, w, 0, 0) - 1.0;
        const double around = 2.0 * core::pi * uniform(seed, w, 1, 0);
        const double flat = std::sqrt(1.0 - height * height);
        // Wave numbers are spread evenly, from a third below to a third above that of a wave two lengths long.
        const double perLength = (2.0 / 3.0 + (w + uniform(seed, w, 2, 0)) * (2.0 / 3.0) / gustWaveCount) * 0.5;
        const double number = perLength / field.length;
        waves.wavenumber[0][w] = static_cast<Real>(number * flat * core::cosine(around));
        waves.wavenumber[1][w] = static_cast<Real>(number * height);
        waves.wavenumber[2][w] = static_cast<Real>(number * flat * core::sine(around));

        const double turns = uniform(seed, w, 3, 0) - perLength * (t / field.period);
        waves.phase[w] = static_cast<Real>(turns - std::floor(turns + 0.5));
        for (int axis = 0; axis < 3; ++axis) {
            // Each component of the strength turns at its own time of the period.
            const double s = t / field.period + uniform(seed, w, 4 + axis, 0);
            waves.strength[axis][w] = static_cast<Real>(gain * field.amplitude * wander(seed, w, 8 + axis, s));
        }
    }
    waves.inverseLimitSquared = static_cast<Real>(1.0 / (field.amplitude * field.amplitude));
    return waves;
}

glm::dvec3 gustVelocity(const GustField& field, double t, const glm::dvec3& x) {
    const GustWaves<double> waves = gustWaves<double>(field, t);
    glm::dvec3 g(0.0);
    for (int w = 0; w < gustWaveCount; ++w) {
        const double turns =
            waves.wavenumber[0][w] * x.x + waves.wavenumber[1][w] * x.y + waves.wavenumber[2][w] * x.z + waves.phase[w];
        const double r = turns - std::floor(turns + 0.5);
        const double wave = r * (gustWaveShape[0] + r * r * (gustWaveShape[1] + r * r * gustWaveShape[2]));
        for (int axis = 0; axis < 3; ++axis) g[axis] += waves.strength[axis][w] * wave;
    }
    return g / std::sqrt(1.0 + glm::dot(g, g) * waves.inverseLimitSquared);
}

template GustWaves<float> gustWaves<float>(const GustField&, double);
template GustWaves<double> gustWaves<double>(const GustField&, double);

}  // namespace taut::mechanics
