// Blocks that fill a mesh: cells by their share, and a bar that lies askew in them as stiff as one that does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mechanics_box_mesh.h"
#include "mechanics_lattice_facts.h"
#include "mechanics_planar_state.h"
#include "taut/core/trig.h"
#include "taut/mechanics/builders.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/volume.h"

namespace taut::mechanics {
namespace {

using namespace test;
using glm::dmat3;
using glm::dvec3;

void turn(Mesh& mesh, const dmat3& by) {
    for (dvec3& x : mesh.positions) x = by * x;
}

// About z, then about x.
dmat3 turned(double aboutZ, double aboutX) {
    const double c = std::cos(aboutZ), s = std::sin(aboutZ), d = std::cos(aboutX), t = std::sin(aboutX);
    return dmat3(dvec3(1, 0, 0), dvec3(0, d, t), dvec3(0, -t, d)) *
           dmat3(dvec3(c, s, 0), dvec3(-s, c, 0), dvec3(0, 0, 1));
}

double filled(const Lattice& lattice) {
    return std::accumulate(
               lattice.cells.begin(), lattice.cells.end(), 0.0,
               [&](double sum, const LatticeCell& cell) { return sum + cell.share(); }) *
           lattice.cell.x * lattice.cell.y * lattice.cell.z;
}

// A bar of 1 × 0.2 × 0.2 m from the origin on along the first of some axes is held by its first 0.1 m under its own
// weight: how much it is bent (across) or stretched between places at 0.3, 0.6 and 0.9 m. The hanging part bends
// it, however the bar is held.
struct Hanging {
    double bent, stretched;
};
Hanging hang(const Model& model, const Lattice& lattice, const dmat3& axes, const dvec3& low) {
    const std::size_t n = model.positions.size();
    const PlanarState<double> state(model);
    VolumePreservation<double> volume(model.cells, model.positions);
    const auto keepFree = [&](std::vector<dvec3>& v) {
        for (std::size_t i = 0; i < n; ++i)
            if (glm::dot(axes[0], model.positions[i]) < 0.1 + 1e-9) v[i] = dvec3(0.0);
    };
    const auto product = [](const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
        return sum;
    };
    const auto stiffness = [&](const std::vector<dvec3>& u, std::vector<dvec3>& out) {
        std::fill(out.begin(), out.end(), dvec3(0.0));
        addSpringStiffness(model.springs, model.positions, u, out);
        core::AlignedArray<double> in(state.planes()), sum(state.planes());
        for (std::size_t i = 0; i < n; ++i)
            for (int axis = 0; axis < 3; ++axis) in[state.index(static_cast<int>(i), axis)] = u[i][axis];
        volume.addStiffnessProduct(state.motion(), in.data(), sum.data());
        for (std::size_t i = 0; i < n; ++i)
            for (int axis = 0; axis < 3; ++axis) out[i][axis] += sum[state.index(static_cast<int>(i), axis)];
    };
    const auto under = [&](const dvec3& gravity) {
        std::vector<dvec3> u(n, dvec3(0.0)), r(n), q(n);
        for (std::size_t i = 0; i < n; ++i) r[i] = model.masses[i] * gravity;
        keepFree(r);
        std::vector<dvec3> p = r;
        double square = product(r, r);
        const double enough = 1e-14 * square;
        while (square > enough) {
            stiffness(p, q);
            keepFree(q);
            const double step = square / product(p, q), before = square;
            for (std::size_t i = 0; i < n; ++i) {
                u[i] += step * p[i];
                r[i] -= step * q[i];
            }
            square = product(r, r);
            for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + square / before * p[i];
        }
        return u;
    };
    // In the middle of the section.
    const auto at = [&](const std::vector<dvec3>& u, double along) {
        const dvec3 x = (along * axes[0] - low) / lattice.cell;
        const CarriedPoint carried = carriedBy(lattice.carrierOf(x), x);
        dvec3 sum(0.0);
        for (std::size_t c = 0; c < 8; ++c) sum += carried.weights[c] * u[carried.points[c]];
        return sum;
    };
    const std::vector<dvec3> across = under(axes[1]), along = under(axes[0]);
    const double bent = glm::dot(axes[1], at(across, 0.3) - 2.0 * at(across, 0.6) + at(across, 0.9));
    return {bent, glm::dot(axes[0], at(along, 0.9) - at(along, 0.3))};
}

BlockShape shapeIn(const Lattice& lattice) {
    BlockShape shape;
    shape.density = 1.0;
    shape.young = 1.0;
    shape.lattice = &lattice;
    shape.centre = lattice.centre;
    shape.size = lattice.cell * dvec3(lattice.counts);
    return shape;
}

// Measured 0.965 and 0.992 bent, 1.000 and 1.011 stretched; with the mass of a cell in its middle it would be 1.19
// stiffer where the outer cells are half full.
TEST(MeshLattice, ABarThatLiesAskewIsAsStiffAsABlock) {
    BlockShape shape{.centre = {0.5, 0, 0}, .size = {1.0, 0.2, 0.2}, .cells = {20, 4, 4}, .density = 1.0, .young = 1.0};
    const Lattice full = fullLattice(shape.cells, shape.size);
    const Hanging block = hang(buildBlock(shape), full, dmat3(1.0), {0.0, -0.1, -0.1});
    for (const dmat3& axes : {turned(0.785, 0.0), turned(0.4, 0.7)}) {
        Mesh bar;
        addBox(bar, {0.0, -0.1, -0.1}, {1.0, 0.1, 0.1});
        turn(bar, axes);
        const Lattice lattice = meshLattice(bar.positions, bar.triangles, 0.05);
        const BlockShape meshed = shapeIn(lattice);
        const Hanging hanging = hang(buildBlock(meshed), lattice, axes, lattice.centre - 0.5 * meshed.size);
        EXPECT_NEAR(hanging.bent / block.bent, 1.0, 0.05);
        EXPECT_NEAR(hanging.stretched / block.stretched, 1.0, 0.05);
    }
}

TEST(MeshLattice, ABoxThatFillsItsCellsIsTheBlock) {
    Mesh box;
    addBox(box, {1.0, 2.0, 3.0}, {1.75, 2.5, 3.5});
    const Lattice lattice = meshLattice(box.positions, box.triangles, 0.25);
    const Model meshed = buildBlock(shapeIn(lattice));
    BlockShape shape = shapeIn(lattice);
    shape.lattice = nullptr;
    shape.cells = {3, 2, 2};
    const Model block = buildBlock(shape);
    EXPECT_EQ(meshed.positions, block.positions);
    EXPECT_EQ(meshed.masses, block.masses);
    EXPECT_EQ(meshed.triangles, block.triangles);
    ASSERT_EQ(meshed.springs.size(), block.springs.size());
    for (std::size_t i = 0; i < block.springs.size(); ++i) {
        EXPECT_EQ(meshed.springs[i].b, block.springs[i].b);
        EXPECT_EQ(meshed.springs[i].stiffness, block.springs[i].stiffness);
    }
    ASSERT_EQ(meshed.cells.size(), block.cells.size());
    EXPECT_EQ(meshed.cells.back().bulkModulus, block.cells.back().bulkModulus);
}

// Two boxes apart from each other, of which one is hollow, turned, in cells of which none is full. The least mass of a
// corner moves the centre by less than a hundredth of a cell.
TEST(MeshLattice, WeighsWhatIsInsideOfTheMesh) {
    Mesh mesh;
    addBox(mesh, {0, 0, 0}, {1.0, 0.7, 0.7});
    addBox(mesh, {0.1, 0.1, 0.1}, {0.9, 0.5, 0.6}, true);
    addBox(mesh, {2.0, 0, 0}, {2.3, 0.7, 0.7});
    turn(mesh, turned(0.3, 0.5));
    const Model model = buildBlock(shapeIn(meshLattice(mesh.positions, mesh.triangles, 0.3)));
    const double all = 0.49, hollow = 0.8 * 0.4 * 0.5, beside = 0.3 * 0.49, mass = all - hollow + beside;
    const dvec3 moment =
        all * dvec3(0.5, 0.35, 0.35) - hollow * dvec3(0.5, 0.3, 0.35) + beside * dvec3(2.15, 0.35, 0.35);
    EXPECT_NEAR(totalMass(model), mass, 1e-12);
    EXPECT_NEAR(glm::distance(centreOfMass(model), turned(0.3, 0.5) * moment / mass), 0.0, 3e-3);
    EXPECT_EQ(brokenRule(model), "");
}

// An ellipsoid, 6 cells along its shortest axis, has a²/5 of its mass along each axis. Its faces are chords, 0.4 %
// less.
TEST(MeshLattice, AnEllipsoidTurnsAsOne) {
    const glm::dvec3 half(0.45, 0.3, 0.36);
    Mesh mesh;
    constexpr int rings = 24, around = 48;
    const auto at = [&](int ring, int step) {
        const double theta = core::pi * ring / rings, phi = 2.0 * core::pi * (step % around) / around;
        return half * glm::dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    const auto number = [](int ring, int step) {
        return ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * around + step % around;
    };
    mesh.positions = {at(0, 0), at(rings, 0)};
    for (int ring = 1; ring < rings; ++ring)
        for (int step = 0; step < around; ++step) mesh.positions.push_back(at(ring, step));
    for (int ring = 0; ring < rings; ++ring)
        for (int step = 0; step < around; ++step) {
            const int a = number(ring, step), b = number(ring + 1, step), c = number(ring + 1, step + 1),
                      d = number(ring, step + 1);
            if (ring + 1 < rings) mesh.triangles.push_back({a, b, c});
            if (ring > 0) mesh.triangles.push_back({a, c, d});
        }
    const glm::dvec3 square = meanSquares(buildBlock(shapeIn(meshLattice(mesh.positions, mesh.triangles, 0.1))));
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(square[axis] / (half[axis] * half[axis] / 5.0), 1.0, 0.02) << axis;
}

// Forces at the vertices of a mesh, handed to the points that carry them, have the same sum and torque; vertices beyond
// all cells, where one was left out, too.
TEST(MeshLattice, ForcesAtTheSurfaceGoToItsCellsWithTheirTorque) {
    Mesh mesh;
    addBox(mesh, {0, 0, 0}, {1.0, 0.7, 0.71});
    turn(mesh, turned(0.3, 0.5));
    const Lattice lattice = meshLattice(mesh.positions, mesh.triangles, 0.3);
    const Model model = buildBlock(shapeIn(lattice));
    const dvec3 low = lattice.centre - 0.5 * lattice.cell * dvec3(lattice.counts);
    dvec3 force(0.0), torque(0.0), carriedForce(0.0), carriedTorque(0.0);
    int beyond = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const dvec3 f(1.0 + static_cast<double>(v), 2.0, -3.0 * static_cast<double>(v)), &x = mesh.positions[v];
        force += f;
        torque += glm::cross(x, f);
        const dvec3 place = (x - low) / lattice.cell;
        const CarriedPoint carried = carriedBy(lattice.carrierOf(place), place);
        for (std::size_t c = 0; c < 8; ++c) {
            beyond += carried.weights[c] < 0.0 ? 1 : 0;
            carriedForce += carried.weights[c] * f;
            carriedTorque += glm::cross(at(model.positions, carried.points[c]), carried.weights[c] * f);
        }
    }
    EXPECT_GT(beyond, 0);
    EXPECT_NEAR(glm::distance(carriedForce, force), 0.0, 1e-13 * glm::length(force));
    EXPECT_NEAR(glm::distance(carriedTorque, torque), 0.0, 1e-13 * glm::length(torque));
}

// A rod of a fifth of a cell, askew: each of its cells has a neighbour at a face.
TEST(MeshLattice, ThinPartsHangTogether) {
    Mesh rod;
    addBox(rod, {0, 0, 0}, {3.0, 0.04, 0.04});
    addBox(rod, {3.5, 0, 0}, {4.5, 0.5, 0.5});
    turn(rod, turned(0.6, 0.4));
    const Lattice lattice = meshLattice(rod.positions, rod.triangles, 0.2);
    std::vector<bool> isReached(lattice.cells.size());
    std::vector<int> found{0};
    isReached[0] = true;
    for (std::size_t next = 0; next < found.size(); ++next)
        for (int axis = 0; axis < 3; ++axis)
            for (const int way : {-1, 1}) {
                glm::ivec3 at = lattice.cells[found[next]].at;
                at[axis] += way;
                const int cell = lattice.cellAt(at);
                if (cell < 0 || isReached[cell]) continue;
                isReached[cell] = true;
                found.push_back(cell);
            }
    double reached = 0.0;
    for (const int cell : found) reached += lattice.cells[cell].share();
    reached *= lattice.cell.x * lattice.cell.y * lattice.cell.z;
    EXPECT_NEAR(std::min(reached, filled(lattice) - reached), 3.0 * 0.04 * 0.04, 1e-11);
}

// Where a rod comes to an end in a cell that it hardly fills, the one before it carries that: a point which weighs
// thousands of times less than its neighbours would be thrown about by them.
TEST(MeshLattice, ThinPartsHaveNoLightEnds) {
    for (double length = 3.0; length < 3.2; length += 0.02) {
        Mesh rod;
        addBox(rod, {0, 0, 0}, {length, 0.04, 0.04});
        turn(rod, turned(0.6, 0.4));
        const Lattice lattice = meshLattice(rod.positions, rod.triangles, 0.2);
        int ends = 0;
        for (const LatticeCell& cell : lattice.cells) {
            std::vector<double> beside;
            for (int axis = 0; axis < 3; ++axis)
                for (const int way : {-1, 1}) {
                    glm::ivec3 at = cell.at;
                    at[axis] += way;
                    if (const int other = lattice.cellAt(at); other >= 0)
                        beside.push_back(lattice.cells[other].share());
                }
            if (beside.size() > 1) continue;
            ++ends;
            EXPECT_GT(cell.share(), 0.2 * beside.at(0)) << length;
        }
        EXPECT_EQ(ends, 2);
        EXPECT_NEAR(filled(lattice), length * 0.04 * 0.04, 1e-11);
    }
}

void expectSaid(const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(MeshLattice, FaultsOfAMeshAreToldApart) {
    const auto faultOf = [](const Mesh& mesh) -> std::string {
        try {
            return meshLattice(mesh.positions, mesh.triangles, 0.25).isFilledTwice ? "filled twice" : "";
        } catch (const MeshFault& fault) {
            return std::to_string(fault.triangle) + " " + fault.what();
        }
    };
    Mesh box;
    addBox(box, dvec3(0.0), dvec3(1.0));
    EXPECT_EQ(faultOf(box), "");
    Mesh open = box;
    open.triangles.erase(open.triangles.begin() + 5);
    expectSaid(faultOf(open), "not closed, so that it has no inside: 3 edges");
    Mesh doubled = box;
    doubled.triangles.push_back(box.triangles[5]);
    expectSaid(faultOf(doubled), "5 the mesh has no inside: at 3 edges three faces meet");
    Mesh twisted = box;
    std::swap(twisted.triangles[7][0], twisted.triangles[7][1]);
    expectSaid(faultOf(twisted), "turned against each other, at 3 edges");
    Mesh inward;
    addBox(inward, dvec3(0.0), dvec3(1.0), true);
    expectSaid(faultOf(inward), "-1 the mesh is inside out");
    Mesh part = box;
    addBox(part, dvec3(2.0), dvec3(2.5), true);
    expectSaid(faultOf(part), "12 the part of the mesh to which this face belongs is inside out");
    Mesh crossed = box;  // its top is turned half round, so that the sides go through each other
    for (const int c : {2, 3, 6, 7}) {
        dvec3& x = crossed.positions[c];
        x = {0.7 - 0.4 * x.x, x.y, x.z};
    }
    expectSaid(faultOf(crossed), "crosses itself");
    Mesh twice = box;
    addBox(twice, dvec3(0.25), dvec3(1.5));
    EXPECT_EQ(faultOf(twice), "filled twice");
}

// Of a plate in the slant of its box, by all cells, the first of the nearest; also at equal distances from several.
TEST(MeshLattice, VerticesOutsideAllCellsFollowTheNearest) {
    Mesh plate;
    addBox(plate, dvec3(0.0), dvec3(3.0, 3.0, 0.3));
    turn(plate, turned(0.6, 0.4));
    const Lattice lattice = meshLattice(plate.positions, plate.triangles, 0.15);
    for (int z = -2; z <= 2 * lattice.counts.z; ++z)
        for (int y = -2; y <= 2 * lattice.counts.y; y += 3)
            for (int x = -2; x <= 2 * lattice.counts.x; x += 3) {
                const dvec3 place = 0.5 * dvec3(x, y, z) + 0.25 * static_cast<double>((x + y) % 2);
                const dvec3 inside = glm::clamp(glm::floor(place), dvec3(0.0), dvec3(lattice.counts - 1));
                if (lattice.carriers[lattice.indexOf(glm::ivec3(inside))] >= 0) continue;
                const auto away = [&](const LatticeCell& cell) {
                    const dvec3 way = place - glm::clamp(place, dvec3(cell.at), dvec3(cell.at + 1));
                    return glm::dot(way, way);
                };
                const auto nearest =
                    std::min_element(lattice.cells.begin(), lattice.cells.end(),
                                     [&](const LatticeCell& a, const LatticeCell& b) { return away(a) < away(b); });
                EXPECT_EQ(lattice.carrierOf(place).at, nearest->at) << x << " " << y << " " << z;
            }
}

}  // namespace
}  // namespace taut::mechanics
