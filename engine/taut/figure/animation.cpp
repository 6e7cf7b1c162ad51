#include <algorithm>
#include <cmath>

#include "taut/core/trig.h"
#include "taut/figure/figure.h"

namespace taut::figure {
namespace {

constexpr double nearlyStraight = 0.9995;  // cosine above which a chord is as good as an arc

// [rad] whose cosine is given, 0 … 1. Each round adds the sine of the remainder, which triples the digits.
double arcCosine(double cosine) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    double angle = (1.0 - cosine) * (0.5 * core::pi);
    for (int round = 0; round < 4; ++round) angle += sine * core::cosine(angle) - cosine * core::sine(angle);
    return angle;
}

void normalise(std::span<double> q) {
    double square = 0;
    for (const double value : q) square += value * value;
    const double size = std::sqrt(square);
    for (double& value : q) value = size > 0 ? value / size : 0.0;
    if (!(size > 0)) q.back() = 1.0;
}

// Along the shorter arc.
void slerp(std::span<const double> a, std::span<const double> b, double share, std::span<double> q) {
    double cosine = 0;
    for (std::size_t k = 0; k < 4; ++k) cosine += a[k] * b[k];
    const double sign = cosine < 0 ? -1.0 : 1.0;
    cosine *= sign;
    double first = 1.0 - share, second = share;
    if (cosine < nearlyStraight) {
        const double angle = arcCosine(cosine), sine = core::sine(angle);
        first = core::sine(first * angle) / sine;
        second = core::sine(second * angle) / sine;
    }
    for (std::size_t k = 0; k < 4; ++k) q[k] = first * a[k] + sign * second * b[k];
    normalise(q);
}

}  // namespace

void sample(const Channel& channel, std::size_t width, double seconds, std::span<double> values) {
    const bool isCubic = channel.interpolation == Interpolation::cubic;
    // The numbers of a key: 0 in-tangent, 1 value, 2 out-tangent.
    const auto key = [&](std::size_t k, std::size_t which) {
        const std::size_t at = isCubic ? 3 * k + which : k;
        return std::span(channel.values).subspan(at * width, width);
    };
    const auto stay = [&](std::size_t k) { std::copy_n(key(k, 1).begin(), width, values.begin()); };
    const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), seconds);
    if (after == channel.times.begin()) {
        stay(0);
    } else if (after == channel.times.end() || channel.interpolation == Interpolation::step) {
        stay(static_cast<std::size_t>(after - channel.times.begin()) - 1);
    } else {
        const auto b = static_cast<std::size_t>(after - channel.times.begin()), a = b - 1;
        const double length = channel.times[b] - channel.times[a];
        const double s = (seconds - channel.times[a]) / length;
        if (isCubic) {  // Hermite's
            const double s2 = s * s, s3 = s2 * s;
            for (std::size_t i = 0; i < width; ++i)
                values[i] = (2.0 * s3 - 3.0 * s2 + 1.0) * key(a, 1)[i] + length * (s3 - 2.0 * s2 + s) * key(a, 2)[i] +
                            (3.0 * s2 - 2.0 * s3) * key(b, 1)[i] + length * (s3 - s2) * key(b, 0)[i];
        } else if (channel.path == Path::rotation) {
            slerp(key(a, 1), key(b, 1), s, values);
        } else {
            for (std::size_t i = 0; i < width; ++i) values[i] = key(a, 1)[i] + s * (key(b, 1)[i] - key(a, 1)[i]);
        }
    }
    if (channel.path == Path::rotation) normalise(values);
}

}  // namespace taut::figure
