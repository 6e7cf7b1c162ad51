// Least squares of a few unknowns within bounds, of an expensive function without derivatives, smooth only down to some
// noise (Levenberg 1944, Marquardt 1963). Independent of scenes.
#pragma once

#include <functional>
#include <vector>

namespace taut::study {

using Vector = std::vector<double>;

struct LeastSquares {
    // Residuals at several points of the unknowns, each over its standard deviation; none where there is no value. They
    // may be computed side by side.
    std::function<std::vector<Vector>(const std::vector<Vector>& points)> residuals;
    Vector start, low, high;   // (unknowns) of like size: a step of 1 is a large one
    double difference = 0.02;  // to either side, for derivatives; well above the effect of noise and rounding
    int most = 300;            // points in all
};

// Residuals hardly change along a direction if their change is less than a hundredth of the change along each unknown
// (a correlation of 0.9999, beyond which differences of runs are too rough), or if the standard deviation along it is
// above 1.
struct Minimum {
    Vector x;                        // (unknowns)
    Vector residuals;                // there; none: there are none at the start
    Vector deviation;                // (unknowns) standard deviation; not a number where x is at a bound that holds it
    std::vector<Vector> covariance;  // (unknowns)(unknowns) 0 where x is held
    std::vector<Vector> unseen;      // (directions)(unknowns) of length 1, along which residuals hardly change
    std::vector<bool> isHeld;        // (unknowns) by a bound beyond which the sum would be less
    bool hasConverged = false;       // else it ran out of points
    double sum() const;              // of squares
};

// Expects low < high, and the start between.
Minimum leastSquares(const LeastSquares& problem);

// Of a symmetric matrix, by Jacobi's rotations: values ascending, and a vector of length 1 to each.
struct Eigenvectors {
    Vector values;
    std::vector<Vector> vectors;
};
Eigenvectors eigenvectors(std::vector<Vector> symmetric);

}  // namespace taut::study
