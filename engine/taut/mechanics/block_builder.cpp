#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/builder_support.h"

namespace taut::mechanics {
namespace {

using glm::dvec3;
using glm::ivec3;

// Stiffness of a cell of sides s, from its edges and face diagonals.
//
// Shares. A cell owns a quarter of each of its 12 edges and half of the two diagonals of each of its 6 faces. A whole
// spring has k, so a cell has three edges and six diagonals. Cells that meet add their shares: an inner edge has k, an
// edge in a face k/2, an edge of the block k/4, an inner diagonal k, a diagonal in a face k/2. So a uniform strain
// costs every cell the same energy, at the surface and inside. The energy per volume is that of the infinite lattice.
//
// Cells a x b x c. The two diagonals of the a-b faces, d² = a² + b², give C12 = C66 = 2 k ab/(d² c) and
// C11 = (that) · a²/b². Wanted is C12 = C44 = 0.4 E and C11 = 1.2 E (E with ν = 1/4):
//   diagonal  k = 0.4 E c (a² + b²)/(2ab),     edge along a  k = 0.4 E (bc/a) (3 - a²/b² - a²/c²).
// A cube has 0.4 E ℓ for both. The edge's bracket falls to zero for a/b = a/c = 1.22. It is kept at 0.1 or more. So a
// very long cell is stiffer than E along its longest side: choose cells that are nearly cubes.
struct LatticeStiffness {
    dvec3 edge;      // along x, y, z [N/m]
    dvec3 diagonal;  // in the faces across x, y, z [N/m]
};

LatticeStiffness stiffnessOf(double young, const dvec3& s) {
    LatticeStiffness k;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = s[axis], b = s[(axis + 1) % 3], c = s[(axis + 2) % 3];
        const double bracket = 3.0 - a * a / (b * b) - a * a / (c * c);
        k.edge[axis] = 0.4 * young * (b * c / a) * std::max(bracket, 0.1);
        k.diagonal[axis] = 0.4 * young * a * ((b * b + c * c) / (2.0 * b * c));
    }
    return k;
}

// Springs alone have λ = μ, which is ν = 1/4. They take all of the shear modulus μ; a pressure κ (V/V0 - 1) takes the
// rest of λ = 2 μ ν/(1 - 2ν).
struct Moduli {
    double springs;   // Young's modulus of the springs alone, 5/2 μ [Pa]
    double pressure;  // κ [Pa]
};

Moduli moduliOf(const BlockShape& shape) {
    if (shape.bulk) return {shape.young, *shape.bulk};
    const double shear = shape.young / (2.0 * (1.0 + shape.poisson));
    return {2.5 * shear, shear * (2.0 * shape.poisson / (1.0 - 2.0 * shape.poisson) - 1.0)};
}

class LatticeBuilder {
  public:
    explicit LatticeBuilder(const BlockShape& shape)
        : shape_(shape), moduli_(moduliOf(shape)), n_(shape.cells), s_(shape.size / dvec3(n_)) {}

    Model build() {
        detail::addRestingPoints(model_, (n_.x + 1) * (n_.y + 1) * (n_.z + 1), shape_.dragRate);
        addPoints();
        addSprings();
        addCells();
        for (int axis = 0; axis < 3; ++axis) {
            addFace(axis, false);
            addFace(axis, true);
        }
        return std::move(model_);
    }

  private:
    int at(ivec3 p) const { return (p.z * (n_.y + 1) + p.y) * (n_.x + 1) + p.x; }
    bool isInner(ivec3 p, int axis) const { return p[axis] > 0 && p[axis] < n_[axis]; }
    double half(ivec3 p, int axis) const { return isInner(p, axis) ? 1.0 : 0.5; }

    // Calls visit(p) for all p from `first` to `last` inclusive, x fastest.
    template <class Visit>
    static void forBox(ivec3 first, ivec3 last, Visit visit) {
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) visit(ivec3(x, y, z));
    }

    void addPoints() {
        static const char* const names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
        const double mass = shape_.density * shape_.size.x * shape_.size.y * shape_.size.z;
        const double cell = shape_.density * s_.x * s_.y * s_.z;
        forBox(ivec3(0), n_, [&](ivec3 p) {
            const auto i = static_cast<std::size_t>(at(p));
            const dvec3 local = shape_.size * (dvec3(p) / dvec3(n_) - 0.5);
            model_.positions[i] = detail::withoutNegativeZero(shape_.centre + shape_.axes * local);
            model_.masses[i] = shape_.lumping == Lumping::uniform ? mass / model_.pointCount()
                                                                  : cell * half(p, 0) * half(p, 1) * half(p, 2);
            int faces = 0;
            for (int axis = 0; axis < 3; ++axis) {
                if (isInner(p, axis)) continue;
                ++faces;
                model_.groups[names[axis][p[axis] == 0 ? 0 : 1]].push_back(at(p));
            }
            if (faces == 3) model_.groups["corners"].push_back(at(p));
        });
    }

    void addSprings() {
        const LatticeStiffness k = stiffnessOf(moduli_.springs, s_);
        auto add = [this](ivec3 from, ivec3 to, double stiffness, double restLength, SpringKind kind) {
            model_.springs.push_back({at(from), at(to), stiffness, restLength, shape_.dampingTime, kind});
        };
        for (int x = 0; x < 3; ++x) {  // edges along each axis
            const int y = (x + 1) % 3, z = (x + 2) % 3;
            ivec3 step(0);
            step[x] = 1;
            forBox(ivec3(0), n_ - step, [&](ivec3 p) {
                add(p, p + step, k.edge[x] * half(p, y) * half(p, z), s_[x], SpringKind::structural);
            });
        }
        for (int x = 0; x < 3; ++x) {  // both diagonals of the faces across each axis
            const int y = (x + 1) % 3, z = (x + 2) % 3;
            const double d = std::sqrt(s_[y] * s_[y] + s_[z] * s_[z]);
            ivec3 stepY(0), stepZ(0);
            stepY[y] = 1;
            stepZ[z] = 1;
            const ivec3 last = n_ - stepY - stepZ;
            forBox(
                ivec3(0), last,
                [&](ivec3 p) { add(p, p + stepY + stepZ, k.diagonal[x] * half(p, x), d, SpringKind::shear); });
            forBox(ivec3(0), last,
                   [&](ivec3 p) { add(p + stepY, p + stepZ, k.diagonal[x] * half(p, x), d, SpringKind::shear); });
        }
    }

    void addCells() {
        if (shape_.bulk == 0.0) return;
        forBox(ivec3(0), n_ - 1, [&](ivec3 p) {
            VolumeCell cell{{}, s_.x * s_.y * s_.z, moduli_.pressure};
            for (int c = 0; c < 8; ++c)
                cell.points[static_cast<std::size_t>(c)] = at(p + ivec3(c & 1, c >> 1 & 1, c >> 2));
            model_.cells.push_back(cell);
        });
    }

    // The surface across an axis at its low or high end, counter-clockwise seen from outside.
    void addFace(int x, bool isHigh) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        ivec3 first(0), last = n_ - 1, stepY(0), stepZ(0);
        first[x] = last[x] = isHigh ? n_[x] : 0;
        stepY[y] = 1;
        stepZ[z] = 1;
        if (!isHigh) std::swap(stepY, stepZ);
        forBox(first, last, [&](ivec3 p) {
            model_.triangles.push_back({at(p), at(p + stepY), at(p + stepY + stepZ)});
            model_.triangles.push_back({at(p), at(p + stepY + stepZ), at(p + stepZ)});
        });
    }

    const BlockShape& shape_;
    Moduli moduli_;
    ivec3 n_;
    dvec3 s_;  // [m] sides of a cell
    Model model_;
};

}  // namespace

Model buildBlock(const BlockShape& shape) {
    TAUT_EXPECTS(shape.cells.x >= 1 && shape.cells.y >= 1 && shape.cells.z >= 1);
    TAUT_EXPECTS(shape.size.x > 0.0 && shape.size.y > 0.0 && shape.size.z > 0.0);
    TAUT_EXPECTS(glm::determinant(shape.axes) > 0.0);
    TAUT_EXPECTS(shape.bulk || (shape.poisson >= 0.25 && shape.poisson < 0.5));
    return LatticeBuilder(shape).build();
}

std::vector<std::string> blockGroups() {
    return {"left", "right", "bottom", "top", "back", "front", "corners"};
}

}  // namespace taut::mechanics
