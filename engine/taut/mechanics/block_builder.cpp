#include <algorithm>
#include <array>
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
// Shares (lattice.h). A full cell owns a quarter of each of its 12 edges and half of the two diagonals of each of its 6
// faces. A whole spring has k, so a cell has three edges and six diagonals. Cells that meet add their shares: an inner
// edge has k, an edge in a face k/2, an edge of the block k/4, an inner diagonal k, a diagonal in a face k/2. So a
// uniform strain costs every cell the same energy, at the surface and inside. The energy per volume is that of the
// infinite lattice.
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
    LatticeBuilder(const BlockShape& shape, const Lattice& lattice)
        : shape_(shape), lattice_(lattice), moduli_(moduliOf(shape)), n_(lattice.counts), s_(lattice.cell) {
        numbers_.assign(indexOf(n_) + 1, -1);
        for (std::size_t i = 0; i < lattice_.points.size(); ++i)
            numbers_[indexOf(lattice_.points[i])] = static_cast<int>(i);
    }

    Model build() {
        detail::addRestingPoints(model_, static_cast<int>(lattice_.points.size()), shape_.dragRate);
        addPoints();
        if (shape_.lumping != Lumping::uniform) matchInertia();
        addSprings();
        addCells();
        for (int axis = 0; axis < 3; ++axis) {
            addFaces(axis, false);
            addFaces(axis, true);
        }
        return std::move(model_);
    }

  private:
    std::size_t indexOf(ivec3 p) const { return indexIn(n_ + 1, p); }
    int at(ivec3 p) const { return numbers_[indexOf(p)]; }
    // The share of the cell at a place in a corner.
    double share(ivec3 cell, ivec3 corner) const {
        const int number = lattice_.cellAt(cell);
        if (number < 0) return 0.0;
        return lattice_.cells[number].shares[corner.x + 2 * corner.y + 4 * corner.z];
    }

    // Calls visit(p) for all p from `first` to `last` inclusive, x fastest.
    template <class Visit>
    static void forBox(ivec3 first, ivec3 last, Visit visit) {
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) visit(ivec3(x, y, z));
    }

    void addPoints() {
        static const char* const names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
        const double cell = shape_.density * s_.x * s_.y * s_.z;
        double mass = shape_.density * shape_.size.x * shape_.size.y * shape_.size.z;
        if (shape_.lattice != nullptr) {
            mass = 0.0;
            for (const LatticeCell& c : lattice_.cells) mass += cell * c.share();
        }
        ivec3 low = n_, high(0);
        for (const ivec3& p : lattice_.points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        for (std::size_t i = 0; i < lattice_.points.size(); ++i) {
            const ivec3 p = lattice_.points[i];
            const dvec3 local = shape_.size * (dvec3(p) / dvec3(n_) - 0.5);
            model_.positions[i] = detail::withoutNegativeZero(shape_.centre + shape_.axes * local);
            double sum = 0.0;
            forBox(ivec3(0), ivec3(1), [&](ivec3 corner) { sum += share(p - corner, corner); });
            model_.masses[i] = shape_.lumping == Lumping::uniform ? mass / model_.pointCount() : cell * sum;
            int faces = 0;
            for (int axis = 0; axis < 3; ++axis) {
                if (p[axis] != low[axis] && p[axis] != high[axis]) continue;
                ++faces;
                model_.groups[names[axis][p[axis] == low[axis] ? 0 : 1]].push_back(static_cast<int>(i));
            }
            if (faces == 3 && shape_.lattice == nullptr) model_.groups["corners"].push_back(static_cast<int>(i));
        }
    }

    // With a cell's mass in its corners a body turns as if it had (1 + 2/n²) of its inertia, n cells along: each cell
    // has h²/6 too much of the second moment m x². So masses are scaled by a + b x + c x² along each axis, such that
    // mass, centre and second moment are those of the volume; in a box of 2 cells, these are Simpson's weights. The
    // axes of other shapes change each other a little, hence the rounds. A single cell has no point inside and stays as
    // it is.
    void matchInertia() {
        constexpr int rounds = 4;
        constexpr double leastScale = 0.5;
        std::vector<double>& masses = model_.masses;
        std::array<double, 5> sums{};  // of m x^k
        const auto sum = [&](int axis, double origin) {
            sums = {};
            for (std::size_t i = 0; i < masses.size(); ++i) {
                double term = masses[i];
                for (double& to : sums) {
                    to += term;
                    term *= lattice_.points[i][axis] - origin;  // in sides of a cell
                }
            }
        };
        dvec3 centres, wanted;
        for (int axis = 0; axis < 3; ++axis) {
            sum(axis, 0.0);
            sum(axis, centres[axis] = sums[1] / sums[0]);
            wanted[axis] = sums[2] - sums[0] / 6.0;
        }
        for (int round = 0; round < rounds; ++round)
            for (int axis = 0; axis < 3; ++axis) {
                const double centre = centres[axis];
                sum(axis, centre);
                const glm::dmat3 moments{sums[0], sums[1], sums[2], sums[1], sums[2],
                                         sums[3], sums[2], sums[3], sums[4]};
                const dvec3 scale = glm::inverse(moments) * dvec3(sums[0], 0.0, wanted[axis]);
                const auto scaleAt = [&](double x) {
                    return scale.x + (x - centre) * (scale.y + (x - centre) * scale.z);
                };
                if (!(std::min(scaleAt(0.0), scaleAt(n_[axis])) > leastScale)) continue;
                for (std::size_t i = 0; i < masses.size(); ++i) masses[i] *= scaleAt(lattice_.points[i][axis]);
            }
    }

    void addSprings() {
        const LatticeStiffness k = stiffnessOf(moduli_.springs, s_);
        auto add = [this](ivec3 from, ivec3 to, double stiffness, double restLength, SpringKind kind) {
            if (stiffness > 0.0)
                model_.springs.push_back({at(from), at(to), stiffness, restLength, shape_.dampingTime, kind});
        };
        for (int x = 0; x < 3; ++x) {  // edges along each axis
            ivec3 step(0), beside(1);
            step[x] = 1;
            beside[x] = 0;
            forBox(ivec3(0), n_ - step, [&](ivec3 p) {
                double sum = 0.0;  // of the cells around it
                forBox(ivec3(0), beside,
                       [&](ivec3 corner) { sum += share(p - corner, corner) + share(p - corner, corner + step); });
                add(p, p + step, k.edge[x] * sum, s_[x], SpringKind::structural);
            });
        }
        for (int x = 0; x < 3; ++x) {  // both diagonals of the faces across each axis
            const int y = (x + 1) % 3, z = (x + 2) % 3;
            const double d = std::sqrt(s_[y] * s_[y] + s_[z] * s_[z]);
            ivec3 stepX(0), stepY(0), stepZ(0);
            stepX[x] = stepY[y] = stepZ[z] = 1;
            const ivec3 last = n_ - stepY - stepZ;
            const auto stiffness = [&](ivec3 p) {
                double sum = 0.0;  // of the cells on both sides
                forBox(
                    ivec3(0), stepY + stepZ,
                    [&](ivec3 corner) { sum += share(p, corner) + share(p - stepX, corner + stepX); });
                return k.diagonal[x] * sum;
            };
            forBox(
                ivec3(0), last, [&](ivec3 p) { add(p, p + stepY + stepZ, stiffness(p), d, SpringKind::shear); });
            forBox(ivec3(0), last, [&](ivec3 p) { add(p + stepY, p + stepZ, stiffness(p), d, SpringKind::shear); });
        }
    }

    void addCells() {
        if (shape_.bulk == 0.0) return;
        for (const LatticeCell& cell : lattice_.cells)
            model_.cells.push_back({cell.points, s_.x * s_.y * s_.z, moduli_.pressure * cell.share()});
    }

    // The surface across an axis at the low or high ends of cells, counter-clockwise seen from outside.
    void addFaces(int x, bool isHigh) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        ivec3 stepX(0), stepY(0), stepZ(0);
        stepX[x] = stepY[y] = stepZ[z] = 1;
        if (!isHigh) std::swap(stepY, stepZ);
        for (const LatticeCell& cell : lattice_.cells) {
            if (lattice_.cellAt(isHigh ? cell.at + stepX : cell.at - stepX) >= 0) continue;
            const ivec3 p = isHigh ? cell.at + stepX : cell.at;
            model_.triangles.push_back({at(p), at(p + stepY), at(p + stepY + stepZ)});
            model_.triangles.push_back({at(p), at(p + stepY + stepZ), at(p + stepZ)});
        }
    }

    const BlockShape& shape_;
    const Lattice& lattice_;
    Moduli moduli_;
    ivec3 n_;
    dvec3 s_;                   // [m] sides of a cell
    std::vector<int> numbers_;  // (places of corners in the box) of points; -1: none
    Model model_;
};

}  // namespace

Model buildBlock(const BlockShape& shape) {
    TAUT_EXPECTS(shape.lattice != nullptr || (shape.cells.x >= 1 && shape.cells.y >= 1 && shape.cells.z >= 1));
    TAUT_EXPECTS(shape.size.x > 0.0 && shape.size.y > 0.0 && shape.size.z > 0.0);
    TAUT_EXPECTS(glm::determinant(shape.axes) > 0.0);
    TAUT_EXPECTS(shape.bulk || (shape.poisson >= 0.25 && shape.poisson < 0.5));
    if (shape.lattice != nullptr) return LatticeBuilder(shape, *shape.lattice).build();
    return LatticeBuilder(shape, fullLattice(shape.cells, shape.size)).build();
}

std::vector<std::string> blockGroups(bool isBox) {
    std::vector<std::string> groups{"left", "right", "bottom", "top", "back", "front"};
    if (isBox) groups.emplace_back("corners");
    return groups;
}

}  // namespace taut::mechanics
