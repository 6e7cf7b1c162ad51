#include "taut/core/trig.h"

#include <cmath>
#include <cstdint>

namespace taut::core {
namespace {

// π/2 in three parts (Cody and Waite): the first two have so few bits that quadrant · part is exact.
constexpr double half1 = 1.57079632673412561417e+00;
constexpr double half2 = 6.07710050630396597660e-11;
constexpr double half3 = 2.02226624879595063154e-21;

// Taylor sums on |r| <= π/4; the first term left out is below 1e-17 relative to the sum.
double sineNearZero(double r) {
    const double s = r * r;
    double sum = 0.0;
    for (int k = 8; k >= 1; --k) sum = (1.0 + sum) * -s / static_cast<double>(2 * k * (2 * k + 1));
    return r + r * sum;
}

double cosineNearZero(double r) {
    const double s = r * r;
    double sum = 0.0;
    for (int k = 8; k >= 1; --k) sum = (1.0 + sum) * -s / static_cast<double>(2 * k * (2 * k - 1));
    return 1.0 + sum;
}

double evaluate(double angle, int shift) {
    const double quadrant = std::floor(angle * (2.0 / pi) + 0.5);
    const double r = ((angle - quadrant * half1) - quadrant * half2) - quadrant * half3;
    const auto which = static_cast<unsigned>(static_cast<std::int64_t>(quadrant) + shift) & 3U;
    const double value = (which & 1U) != 0 ? cosineNearZero(r) : sineNearZero(r);
    return (which & 2U) != 0 ? -value : value;
}

}  // namespace

double sine(double angle) {
    return evaluate(angle, 0);
}
double cosine(double angle) {
    return evaluate(angle, 1);
}

}  // namespace taut::core
