#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/builder_support.h"
#include "taut/mechanics/private/grid_cells.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;

// Stiffness of a cell of a by b, per metre of material.
//
//  a strip of width b holds one spring along a:   force per metre  k (ε a)/b    = k_s ε      ->  k = k_s b/a
//  two diagonals of length d, d² = a² + b²:       C12 = C66 = 2 k ab/d²         = k_d        ->  k = k_d d²/(2ab)
//  span 2, one starts at every point:             force per metre  2·k (2 ε a)/b = 4 k_b ε    ->  k = k_b b/a
//
// k_s is that of the warp along a and that of the weft along b.
// So shear and cross contraction are k_d for every cell. C11 = k_s + k_d a²/b² + 4 k_b: the diagonals of a cell that is
// longer than wide carry more along its length. Square cells have C11 = k_s + k_d + 4 k_b.
struct CellStiffness {
    double across, down, falling, rising, bendAcross, bendDown;  // [N/m]
};

CellStiffness stiffnessOf(const ClothMaterial& material, double a, double b) {
    const double diagonal = material.shear * (a * a + b * b) / (2.0 * a * b);
    return {material.stretch * b / a,
            material.weftStretch.value_or(material.stretch) * a / b,
            diagonal,
            diagonal,
            material.bend * b / a,
            material.bend * a / b};
}

// The same for a warp that is turned from a. The sheet is one of fibres n of strength σ: warp, weft, and 2 k_d along
// each of the diagonals between them. Springs of the grid take its Σ σ n⊗n⊗n⊗n over: C1122 by the diagonals, which
// alone have it, C1111 and C2222 by the sum of the sides, and C1112 and C1222 as closely as the difference of the
// diagonals can. They cannot push: where one would have to, it is left out. Woven cloth is worst off at 22.5°: 0.7
// times as stiff along its threads as it should be, and five times in shear.
CellStiffness turnedStiffness(const ClothMaterial& material, double grain, double a, double b) {
    const double strengths[] = {material.stretch, 2.0 * material.shear, material.weftStretch.value_or(material.stretch),
                                2.0 * material.shear};
    double c1111 = 0.0, c2222 = 0.0, c1122 = 0.0, c1112 = 0.0, c1222 = 0.0;
    for (int k = 0; k < 4; ++k) {
        const double angle = grain + k * std::numbers::pi / 4.0, c = core::cosine(angle), s = core::sine(angle);
        c1111 += strengths[k] * c * c * c * c;
        c2222 += strengths[k] * s * s * s * s;
        c1122 += strengths[k] * c * c * s * s;
        c1112 += strengths[k] * c * c * c * s;
        c1222 += strengths[k] * c * s * s * s;
    }
    // Strengths of diagonals times (a b)²/d⁴; a spring has the strength k d²/(a b), k a/b or k b/a.
    const double aa = a * a, bb = b * b, turn = a * b * (aa * c1112 + bb * c1222) / (aa * aa + bb * bb);
    const double scale = (aa + bb) / (2.0 * a * b);
    return {std::max(c1111 - c1122 * aa / bb, 0.0) * b / a,
            std::max(c2222 - c1122 * bb / aa, 0.0) * a / b,
            std::max(c1122 + turn, 0.0) * scale,
            std::max(c1122 - turn, 0.0) * scale,
            material.bend * b / a,
            material.bend * a / b};
}

// A warp that is turned by whole quarters and a rest of at most an eighth is one that is turned by the rest, with warp
// and weft changed as often.
ClothShape withLeastGrain(ClothShape shape) {
    const double quarters = std::round(shape.grain / (0.5 * std::numbers::pi));
    shape.grain -= quarters * 0.5 * std::numbers::pi;
    if (std::abs(shape.grain) < 1e-9) shape.grain = 0.0;
    if (std::fmod(quarters, 2.0) == 0.0) return shape;
    ClothMaterial& material = shape.material;
    std::swap(material.rigidity.along, material.rigidity.across);
    if (material.weftStretch) std::swap(material.stretch, *material.weftStretch);
    return shape;
}

class GridBuilder {
  public:
    explicit GridBuilder(const ClothShape& shape)
        : shape_(withLeastGrain(shape)),
          grain_(shape.grain),
          nu_(shape.cells.x),
          nv_(shape.cells.y),
          a_(shape.size.x / nu_),
          b_(shape.size.y / nv_),
          cells_{nu_, nv_, shape.isRound} {}

    Model build() {
        detail::addRestingPoints(model_, (nu_ + 1) * (nv_ + 1), shape_.material.dragRate);
        model_.grid = {nu_, nv_};
        model_.grain = grain_;
        addPoints();
        addSprings();
        addTriangles();
        addBending();
        addGroups();
        return std::move(model_);
    }

  private:
    int at(int i, int j) const { return j * (nu_ + 1) + i; }
    bool isWeighted() const { return shape_.material.lumping == Lumping::weighted; }
    // An edge stands for half the width of the cells beside it, one of several lengths for that of the narrowest.
    double share(int i, int j, int di, int dj) const {
        if (di != 0 && dj != 0) return cells_.has(std::min(i, i + di), j) ? 1.0 : 0.0;
        int least = 2;
        for (int k = 0; k < di + dj; ++k)
            least = std::min(least, di > 0 ? cells_.beside(i + k, j, 1, 0) : cells_.beside(i, j + k, 0, 1));
        return isWeighted() ? least / 2.0 : std::min(least, 1);
    }

    void addPoints() {
        int count = 0;
        for (int c = 0; c < nu_ * nv_; ++c) count += cells_.has(c % nu_, c / nu_) ? 1 : 0;
        std::vector<int>& all = model_.groups["all"];
        std::erase_if(all, [&](int p) { return cells_.around(p % (nu_ + 1), p / (nu_ + 1)) == 0; });
        const double filled = static_cast<double>(count) / (nu_ * nv_), cell = shape_.material.density * a_ * b_,
                     each = shape_.material.density * shape_.size.x * shape_.size.y * filled /
                            static_cast<double>(all.size());
        for (int j = 0; j <= nv_; ++j)
            for (int i = 0; i <= nu_; ++i) {
                const auto p = static_cast<std::size_t>(at(i, j));
                const double u = shape_.size.x * i / nu_, v = shape_.size.y * j / nv_;
                model_.positions[p] = detail::withoutNegativeZero(shape_.origin + u * shape_.across + v * shape_.down);
                model_.uv[p] = {u, v};
                model_.masses[p] = isWeighted() ? cell * cells_.around(i, j) / 4.0 : each;
                if (cells_.around(i, j) > 0) continue;
                model_.masses[p] = 1e-9 * cell;  // left out: it stays where it is and weighs next to nothing
                model_.held[p] = true;
            }
    }

    // Springs from every point (i, j) of a window to (i + di, j + dj), row by row.
    void addKind(SpringKind kind, int i0, int i1, int j1, int di, int dj, double k, double restLength) {
        if (k == 0.0 && kind != SpringKind::structural) return;
        for (int j = 0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i) {
                const double factor = share(i, j, di, dj);
                if (factor == 0.0) continue;
                model_.springs.push_back(
                    {at(i, j), at(i + di, j + dj), k * factor, restLength, shape_.material.dampingTime, kind});
            }
    }

    void addSprings() {
        const CellStiffness k = shape_.grain == 0.0 ? stiffnessOf(shape_.material, a_, b_)
                                                    : turnedStiffness(shape_.material, shape_.grain, a_, b_);
        const double d = std::sqrt(a_ * a_ + b_ * b_);
        addKind(SpringKind::structural, 0, nu_ - 1, nv_, 1, 0, k.across, a_);
        addKind(SpringKind::structural, 0, nu_, nv_ - 1, 0, 1, k.down, b_);
        addKind(SpringKind::shear, 0, nu_ - 1, nv_ - 1, 1, 1, k.falling, d);
        addKind(SpringKind::shear, 1, nu_, nv_ - 1, -1, 1, k.rising, d);
        addKind(SpringKind::bend, 0, nu_ - 2, nv_, 2, 0, k.bendAcross, 2.0 * a_);
        addKind(SpringKind::bend, 0, nu_, nv_ - 2, 0, 2, k.bendDown, 2.0 * b_);
    }

    void addBending() {
        const BendingRigidity& rigidity = shape_.material.rigidity;
        if (!(rigidity.along > 0.0) && !(rigidity.across > 0.0)) return;
        if (shape_.grain != 0.0) {
            // Bends and twists are coupled then, which the grid's own second differences are not.
            const dvec3 warp = core::cosine(shape_.grain) * shape_.across + core::sine(shape_.grain) * shape_.down;
            model_.freeform = {.rigidity = rigidity,
                               .rest = model_.positions,
                               .warp = std::vector<dvec3>(model_.triangles.size(), warp),
                               .dampingTime = shape_.material.dampingTime};
            return;
        }
        model_.bending = gridBending(nu_ + 1, nv_ + 1, rigidity, a_, b_, shape_.isRound);
        model_.bending.dampingTime = shape_.material.dampingTime;
        const double moment = shape_.material.frictionMoment, yield = shape_.material.frictionYield;
        if (!(yield > 0.0)) return;
        const BendingRigidity stuck{moment / yield, moment / yield, 0, 0};
        model_.friction = {gridBending(nu_ + 1, nv_ + 1, stuck, a_, b_, shape_.isRound),
                           yield,
                           {a_, b_},
                           glm::cross(shape_.across, shape_.down)};
    }

    //  (i,j) --- (i+1,j)     Counter-clockwise seen against down × across: a cloth that hangs in the
    //    |   \      |        x-y plane shows its front to +z.
    //  (i,j+1) - (i+1,j+1)
    void addTriangles() {
        for (int j = 0; j < nv_; ++j)
            for (int i = 0; i < nu_; ++i) {
                if (!cells_.has(i, j)) continue;
                model_.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
                model_.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
            }
    }

    void addGroups() {
        auto& groups = model_.groups;
        const std::vector<int> all = groups["all"];
        for (const int p : all) {
            const int i = p % (nu_ + 1), j = p / (nu_ + 1);
            if (i == 0) groups["left"].push_back(p);
            if (i == nu_) groups["right"].push_back(p);
            if (j == 0) groups["top"].push_back(p);
            if (j == nv_) groups["bottom"].push_back(p);
            if (cells_.around(i, j) < 4) groups["edges"].push_back(p);
            const bool isColumnEnd = i == 0 || i == nu_, isRowEnd = j == 0 || j == nv_;
            if (isColumnEnd && isRowEnd && !shape_.isRound) groups["corners"].push_back(p);
        }
        if (shape_.isRound) return;
        groups["top-left"] = {at(0, 0)};
        groups["top-right"] = {at(nu_, 0)};
        groups["bottom-left"] = {at(0, nv_)};
        groups["bottom-right"] = {at(nu_, nv_)};
    }

    ClothShape shape_;
    double grain_;  // [rad] as given
    int nu_, nv_;
    double a_, b_;  // [m] sides of a cell
    GridCells cells_;
    Model model_;
};

}  // namespace

Model buildCloth(const ClothShape& shape) {
    TAUT_EXPECTS(shape.cells.x >= 1 && shape.cells.y >= 1 && shape.size.x > 0.0 && shape.size.y > 0.0);
    return GridBuilder(shape).build();
}

std::vector<std::string> clothGroups(bool isRound) {
    if (isRound) return {"left", "right", "top", "bottom", "edges"};
    return {"left",      "right",       "top",          "bottom",  "top-left",
            "top-right", "bottom-left", "bottom-right", "corners", "edges"};
}

}  // namespace taut::mechanics
