// The geometry of a cell, from which its stiffness is computed.
//
// The volume of a trilinear hexahedron is the sum of three determinants of differences of corners (Grandy 1997),
//   12 V = (a + a')·(b × c) + a·((b + b') × c') + a'·(b' × (c + c')),
//   a = p6 - p0, a' = p7 - p1, b = p7 - p2, b' = p5 - p0, c = p3 - p0, c' = p7 - p4.
// Two cells that meet share a bilinear face, so the volumes of cells add up to that of the body. Unlike a sum of
// tetrahedra it prefers no diagonal: a bent or twisted cube has no pressure.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "taut/mechanics/model.h"

namespace taut::mechanics {

using CellCorners = std::array<glm::dvec3, 8>;  // [m]
inline constexpr std::array<std::size_t, 8> cellCorners{0, 1, 2, 3, 4, 5, 6, 7};

// The corners of a cell, from planes of points.
template <class Real>
CellCorners cornersOf(const VolumeCell& cell, const Real* planes, std::ptrdiff_t stride) {
    CellCorners p;
    for (std::size_t c = 0; c < p.size(); ++c) {
        const std::ptrdiff_t i = cell.points[c];
        p[c] = {planes[i], planes[i + stride], planes[i + 2 * stride]};
    }
    return p;
}

// The same from points [m].
inline CellCorners cornersOf(const VolumeCell& cell, std::span<const glm::dvec3> points) {
    CellCorners p;
    for (std::size_t c = 0; c < p.size(); ++c) p[c] = points[cell.points[c]];
    return p;
}

inline double volumeOf(const CellCorners& p) {
    const glm::dvec3 a = p[6] - p[0], a1 = p[7] - p[1], b = p[7] - p[2], b1 = p[5] - p[0], c = p[3] - p[0],
                     c1 = p[7] - p[4];
    return (glm::dot(a + a1, glm::cross(b, c)) + glm::dot(a, glm::cross(b + b1, c1)) +
            glm::dot(a1, glm::cross(b1, c + c1))) /
           12.0;
}

// A bilinear form of which ∂V/∂p is the value at (p, p).
inline CellCorners volumeForm(const CellCorners& p, const CellCorners& q) {
    const glm::dvec3 a = p[6] - p[0], a1 = p[7] - p[1], b = p[7] - p[2], b1 = p[5] - p[0], c = p[3] - p[0],
                     c1 = p[7] - p[4];
    const glm::dvec3 e = q[6] - q[0], e1 = q[7] - q[1], f = q[7] - q[2], f1 = q[5] - q[0], g = q[3] - q[0],
                     g1 = q[7] - q[4];
    const glm::dvec3 bc = glm::cross(b, g), ca = glm::cross(c1, e), ab = glm::cross(a1, f1);
    const glm::dvec3 ofA = (bc + glm::cross(b + b1, g1)) / 12.0, ofA1 = (bc + glm::cross(b1, g + g1)) / 12.0;
    const glm::dvec3 ofB = (ca + glm::cross(c, e + e1)) / 12.0, ofB1 = (ca + glm::cross(c + c1, e1)) / 12.0;
    const glm::dvec3 ofC = (ab + glm::cross(a + a1, f)) / 12.0, ofC1 = (ab + glm::cross(a, f + f1)) / 12.0;
    return {-(ofA + ofB1 + ofC), -ofA1, -ofB, ofC, -ofC1, ofB1, ofA, ofA1 + ofB + ofC1};
}

// ∂V/∂p [m²] of each corner.
inline CellCorners gradientsOf(const CellCorners& p) {
    return volumeForm(p, p);
}

// The change of the gradients per step along w.
inline CellCorners gradientsChange(const CellCorners& p, const CellCorners& w) {
    CellCorners sum = volumeForm(p, w);
    const CellCorners other = volumeForm(w, p);
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += other[c];
    return sum;
}

// Corners i < j that V couples: (∂²V/∂p_i∂p_j) u = h × u with h = share (p_k0 + p_k1 - p_l0 - p_l1). They are the ends
// of edges, for which k and l are the other corners of the two faces at the edge, and of diagonals of faces, for which
// k and l are both ends of the other diagonal.
struct CellPair {
    std::size_t i, j;
    std::array<std::size_t, 2> k, l;
    double share;
    glm::dvec3 coupling(const CellCorners& p) const { return share * (p[k[0]] + p[k[1]] - p[l[0]] - p[l[1]]); }
};
inline constexpr std::array<CellPair, 24> cellPairs = [] {
    std::array<CellPair, 24> pairs{};
    std::size_t n = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t x = std::size_t{1} << axis, y = std::size_t{1} << (axis + 1) % 3,
                          z = std::size_t{1} << (axis + 2) % 3;
        for (const std::size_t i : {std::size_t{0}, y, z, y + z}) {  // edges along the axis
            const double sign = i == y || i == z ? -1.0 : 1.0;
            pairs[n++] = {i, i ^ x, {i ^ y, i ^ y ^ x}, {i ^ z, i ^ z ^ x}, sign / 12.0};
        }
        for (const std::size_t i : {std::size_t{0}, x}) {  // diagonals of the faces across it
            const double sign = i == 0 ? -1.0 : 1.0;
            pairs[n++] = {i, i ^ y ^ z, {i ^ y, i ^ y}, {i ^ z, i ^ z}, sign / 24.0};
            pairs[n++] = {i ^ y, i ^ z, {i, i}, {i ^ y ^ z, i ^ y ^ z}, -sign / 24.0};
        }
    }
    for (CellPair& pair : pairs)
        if (pair.i > pair.j) pair = {pair.j, pair.i, pair.l, pair.k, pair.share};
    return pairs;
}();

// A tetrahedron of cellTetrahedra that is turned inside out. A cell can have such ones though its own volume is right.
struct Fold {
    std::array<std::size_t, 4> corners;   // of the cell
    double ratio;                         // V/V0 < 0 of the tetrahedron
    std::array<glm::dvec3, 4> gradients;  // ∂V/∂p of the tetrahedron [m²]
};

// Calls visit(fold) for each fold of a cell whose volume at rest is restVolume [m³].
template <class Visit>
void forEachFold(const CellCorners& p, double restVolume, Visit visit) {
    for (const auto& t : cellTetrahedra) {
        const glm::dvec3 a = p[t[1]] - p[t[0]], b = p[t[2]] - p[t[0]], c = p[t[3]] - p[t[0]];
        const double sixfold = glm::dot(a, glm::cross(b, c));
        if (sixfold >= 0.0) continue;
        const glm::dvec3 ofA = glm::cross(b, c) / 6.0, ofB = glm::cross(c, a) / 6.0, ofC = glm::cross(a, b) / 6.0;
        visit(Fold{t, sixfold / restVolume, {-(ofA + ofB + ofC), ofA, ofB, ofC}});
    }
}

// Pairs of a cell's corners that a fold couples: the part K h × u of (∂²E/∂p_i∂p_j) u.
struct FoldCoupling {
    std::size_t i, j;
    glm::dvec3 h;  // [m]
};
inline std::array<FoldCoupling, 6> couplingsOf(const Fold& fold, const CellCorners& p) {
    const auto [a, b, c, d] = fold.corners;
    const auto between = [&](std::size_t k, std::size_t l) { return fold.ratio / 6.0 * (p[k] - p[l]); };
    return {{{a, b, between(c, d)},
             {a, c, between(d, b)},
             {a, d, between(b, c)},
             {b, c, between(a, d)},
             {b, d, between(c, a)},
             {c, d, between(a, b)}}};
}

// The energy [J] of a cell, as volume.h has it.
inline double volumeEnergy(const VolumeCell& cell, const CellCorners& p) {
    const double change = volumeOf(p) / cell.restVolume - 1.0;
    double squares = change * change;
    forEachFold(p, cell.restVolume, [&](const Fold& fold) { squares += fold.ratio * fold.ratio / 6.0; });
    return 0.5 * cell.bulkModulus * cell.restVolume * squares;
}

}  // namespace taut::mechanics
