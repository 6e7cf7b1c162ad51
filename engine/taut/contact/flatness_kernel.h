// Kernels for the flatness certificate (bvh_flatness.cpp), many triangles at once. One copy for each instruction set;
// all give the same bits. Plain data only.
#pragma once

namespace taut::contact {

// Of triangles (n) whose rest is in a plane.
struct EdgeRows {
    int n;
    const double* first[3];    // [m] from corner 0 to corner 1
    const double* second[3];   // [m] from corner 0 to corner 2
    const double* inverse[4];  // of the matrix of the two edges at rest, row by row
};
// F of the plane's two axes (n): x, y and z of the first, then of the second.
struct GradientRows {
    int n;
    const double* rows;  // (6, n)
};

struct FlatnessKernels {
    // Writes 6 rows, `stride` apart.
    void (*findGradients)(const EdgeRows& edges, double* rows, int stride);
    // least (n) gets the least of t·RᵀF t over all unit t in the plane, from the symmetric part of RᵀF; R has the
    // columns right (3) and up (3).
    void (*findLeast)(const GradientRows& gradients, const double* right, const double* up, double* least);
    // most (n) gets the square of the largest |F t|: the larger eigenvalue of FᵀF.
    void (*findMost)(const GradientRows& gradients, double* most);
};

// For the instruction set in use.
FlatnessKernels flatnessKernels();

}  // namespace taut::contact
