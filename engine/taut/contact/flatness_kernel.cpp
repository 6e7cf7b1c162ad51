// Compiled once for each instruction set; see taut_kernels in engine/taut.cmake.
#include "taut/contact/flatness_kernel.h"

#include "taut/core/private/vectorise.h"

namespace taut::contact::TAUT_ISA {
namespace {

void findGradients(const EdgeRows& edges, double* rows, int stride) {
    const double *a = edges.inverse[0], *b = edges.inverse[1], *c = edges.inverse[2], *d = edges.inverse[3];
    for (int k = 0; k < 3; ++k) {
        const double *first = edges.first[k], *second = edges.second[k];
        double *right = rows + k * stride, *up = right + 3 * stride;
        TAUT_INDEPENDENT
        for (int i = 0; i < edges.n; ++i) {
            right[i] = a[i] * first[i] + c[i] * second[i];
            up[i] = b[i] * first[i] + d[i] * second[i];
        }
    }
}

void findLeast(const GradientRows& gradients, const double* right, const double* up, double* least) {
    const double rx = right[0], ry = right[1], rz = right[2], ux = up[0], uy = up[1], uz = up[2];
    const int n = gradients.n;
    const double *fx = gradients.rows, *fy = fx + n, *fz = fy + n, *gx = fz + n, *gy = gx + n, *gz = gy + n;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double a = rx * fx[i] + ry * fy[i] + rz * fz[i], d = ux * gx[i] + uy * gy[i] + uz * gz[i];
        const double b = 0.5 * ((rx * gx[i] + ry * gy[i] + rz * gz[i]) + (ux * fx[i] + uy * fy[i] + uz * fz[i]));
        const double half = 0.5 * (a - d);
        least[i] = 0.5 * (a + d) - __builtin_sqrt(half * half + b * b);
    }
}

void findMost(const GradientRows& gradients, double* most) {
    const int n = gradients.n;
    const double *fx = gradients.rows, *fy = fx + n, *fz = fy + n, *gx = fz + n, *gy = gx + n, *gz = gy + n;
    TAUT_INDEPENDENT
    for (int i = 0; i < n; ++i) {
        const double p = fx[i] * fx[i] + fy[i] * fy[i] + fz[i] * fz[i];
        const double q = gx[i] * gx[i] + gy[i] * gy[i] + gz[i] * gz[i];
        const double r = fx[i] * gx[i] + fy[i] * gy[i] + fz[i] * gz[i];
        most[i] = 0.5 * (p + q) + __builtin_sqrt(0.25 * (p - q) * (p - q) + r * r);
    }
}

}  // namespace

extern const FlatnessKernels flatness{findGradients, findLeast, findMost};

}  // namespace taut::contact::TAUT_ISA
