// Elementary functions with the same bits on every machine: only + - * / and square roots. The C library's
// own differ between processors and must not reach the state.
#pragma once

namespace taut::core {

inline constexpr double pi = 3.14159265358979323846;

// Sine and cosine of an angle [rad]; absolute error below 1e-15 for |angle| < 1e5.
double sine(double angle);
double cosine(double angle);

// [rad] from degrees.
inline constexpr double radians(double degrees) {
    return degrees * (pi / 180.0);
}

}  // namespace taut::core
