#include "taut/mechanics/sheet_moduli.h"

#include <cmath>
#include <glm/glm.hpp>

namespace taut::mechanics {
namespace {

constexpr double mostDistorted = 0.02;  // of the area, by a map that directions are taken from

}  // namespace

using glm::dvec2;

// Compliances of the orthotropic sheet, turned: Jones, Mechanics of Composite Materials (1999), chapter 2.
StripModuli SheetStiffness::at(double angle) const {
    const double determinant = c11 * c22 - c12 * c12;
    if (!(determinant > 0.0) || !(c66 > 0.0)) return {};
    const double s11 = c22 / determinant, s22 = c11 / determinant, s12 = -c12 / determinant, s66 = 1.0 / c66;
    const double c = std::cos(angle), s = std::sin(angle);
    const double cc = c * c, ss = s * s;
    const double along = s11 * cc * cc + s22 * ss * ss + (2.0 * s12 + s66) * cc * ss;
    const double across = s12 * (cc * cc + ss * ss) + (s11 + s22 - s66) * cc * ss;
    return {1.0 / along, -across / along};
}

SheetStiffness sheetStiffness(const Model& model) {
    const dvec2 warp(std::cos(model.grain), std::sin(model.grain)), weft(-warp.y, warp.x);
    const auto at = [&](int point) {
        const dvec2 uv = model.uv[point];
        return dvec2(glm::dot(uv, warp), glm::dot(uv, weft));
    };
    const auto place = [&](int point) { return model.positions[point]; };
    double area = 0.0, flatArea = 0.0;
    for (const auto& [a, b, c] : model.triangles) {
        const dvec2 e = at(b) - at(a), f = at(c) - at(a);
        flatArea += 0.5 * std::abs(e.x * f.y - e.y * f.x);
        area += 0.5 * glm::length(glm::cross(place(b) - place(a), place(c) - place(a)));
    }
    SheetStiffness sum;
    if (!(area > 0.0)) return sum;
    const bool isDeveloped = std::abs(flatArea - area) < mostDistorted * area;
    for (const Spring& spring : model.springs) {
        if (spring.kind != SpringKind::structural && spring.kind != SpringKind::shear) continue;
        const double share = spring.stiffness * spring.restLength * spring.restLength / area;
        if (!isDeveloped) {  // the mean of n⊗n⊗n⊗n over all directions
            sum.c11 += 0.375 * share;
            sum.c22 += 0.375 * share;
            sum.c12 += 0.125 * share;
            continue;
        }
        const dvec2 e = at(spring.b) - at(spring.a);
        const double length2 = glm::dot(e, e);
        if (!(length2 > 0.0)) continue;
        const double cc = e.x * e.x / length2, ss = e.y * e.y / length2;
        sum.c11 += share * cc * cc;
        sum.c22 += share * ss * ss;
        sum.c12 += share * cc * ss;
    }
    sum.c66 = sum.c12;
    return sum;
}

}  // namespace taut::mechanics
