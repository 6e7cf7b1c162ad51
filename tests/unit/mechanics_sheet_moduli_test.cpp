#include "taut/mechanics/sheet_moduli.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "taut/mechanics/builders.h"

namespace taut::mechanics {
namespace {

// Energy per area of a body strained alike everywhere, of its springs as they stand.
double energy(const Model& model, double area, double uu, double vv, double uv) {
    double sum = 0.0;
    for (const Spring& s : model.springs) {
        const glm::dvec2 e = model.uv[s.b] - model.uv[s.a];
        const double stretch = (uu * e.x * e.x + vv * e.y * e.y + 2.0 * uv * e.x * e.y) / glm::length(e);
        sum += 0.5 * s.stiffness * stretch * stretch;
    }
    return sum / area;
}

// Young's modulus and Poisson's ratio of a strip at an angle, by the least energy over its free transverse strains.
StripModuli byLeastEnergy(const Model& model, double area, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double along, double aside, double shear) {
        return energy(model, area, along * c * c + aside * s * s - 2.0 * shear * c * s,
                      along * s * s + aside * c * c + 2.0 * shear * c * s,
                      (along - aside) * c * s + shear * (c * c - s * s));
    };
    // The energy is quadratic: its coefficients by differences, which are exact.
    const double aa = at(0, 1, 0), bb = at(0, 0, 1), ab = at(0, 1, 1) - aa - bb;
    const double a = at(1, 1, 0) - at(1, 0, 0) - aa, b = at(1, 0, 1) - at(1, 0, 0) - bb;
    const double determinant = 4.0 * aa * bb - ab * ab;
    const double aside = -(2.0 * bb * a - ab * b) / determinant, shear = -(2.0 * aa * b - ab * a) / determinant;
    return {2.0 * at(1, aside, shear), -aside};
}

void expectModuli(const Model& model, double area) {
    for (const double degrees : {0.0, 22.5, 45.0, 90.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const StripModuli strip = sheetStiffness(model).at(angle), least = byLeastEnergy(model, area, angle);
        EXPECT_NEAR(strip.young / least.young, 1.0, 1e-10) << degrees;
        EXPECT_NEAR(strip.poisson, least.poisson, 1e-10) << degrees;
    }
}

ClothMaterial woven() {
    ClothMaterial material;
    material.stretch = 900.0;
    material.weftStretch = 500.0;
    material.shear = 40.0;
    material.bend = 0.0;
    return material;
}

// C11 = warp + shear, C22 = weft + shear, C12 = C66 = shear, at any number of square cells.
TEST(SheetModuli, AGridHasThoseOfItsMaterial) {
    for (const glm::ivec2 cells : {glm::ivec2(1, 2), glm::ivec2(7, 14)}) {
        const Model model = buildCloth({.size = {1.0, 2.0}, .cells = cells, .material = woven()});
        const SheetStiffness sheet = sheetStiffness(model);
        EXPECT_NEAR(sheet.c11, 940.0, 1e-9);
        EXPECT_NEAR(sheet.c22, 540.0, 1e-9);
        EXPECT_NEAR(sheet.c12, 40.0, 1e-9);
        EXPECT_NEAR(sheet.c66, 40.0, 1e-9);
        expectModuli(model, 2.0);
    }
}

// With the warp at 45° diagonals are its threads and sides its diagonals; a quarter turn changes warp and weft.
TEST(SheetModuli, AGridWithATurnedGrainHasThoseOfItsMaterial) {
    for (const double degrees : {45.0, 90.0, -45.0, 180.0, 225.0}) {
        const double grain = degrees * std::numbers::pi / 180.0;
        const SheetStiffness sheet =
            sheetStiffness(buildCloth({.size = {1.0, 2.0}, .cells = {7, 14}, .material = woven(), .grain = grain}));
        EXPECT_NEAR(sheet.c11, 940.0, 1e-9) << degrees;
        EXPECT_NEAR(sheet.c22, 540.0, 1e-9) << degrees;
        EXPECT_NEAR(sheet.c66, 40.0, 1e-9) << degrees;
    }
}

// Squares with one diagonal, k = 4/3 C(φ) (A1 + A2)/c². Edges along the threads have C = warp and weft; at 45° it is
// (warp + weft)/4 + shear.
TEST(SheetModuli, AMeshHasThoseOfItsEdges) {
    for (const int n : {1, 5}) {
        MeshClothShape shape;
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) shape.positions.emplace_back(double(i) / n, double(j) / n, 0.0);
        const auto at = [&](int i, int j) { return j * (n + 1) + i; };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                shape.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                shape.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        shape.material = woven();
        const Model model = buildMeshCloth(shape);
        const double diagonal = 4.0 / 3.0 * ((900.0 + 500.0) / 4.0 + 40.0);
        const SheetStiffness sheet = sheetStiffness(model);
        EXPECT_NEAR(sheet.c11, 4.0 / 3.0 * 900.0 + diagonal / 4.0, 1e-9);
        EXPECT_NEAR(sheet.c22, 4.0 / 3.0 * 500.0 + diagonal / 4.0, 1e-9);
        EXPECT_NEAR(sheet.c12, diagonal / 4.0, 1e-9);
        EXPECT_EQ(sheet.c66, sheet.c12);
    }
}

}  // namespace
}  // namespace taut::mechanics
