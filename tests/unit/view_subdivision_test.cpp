#include "taut/view/private/subdivision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "taut/view/primitives.h"

namespace taut::view::test {
namespace {

// n × n cells, counter-clockwise seen from +z over x and y, whole or each as two triangles.
std::vector<Face> gridFaces(std::uint32_t n, bool isWhole) {
    std::vector<Face> faces;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
            if (isWhole) {
                faces.push_back({a, b, c, d});
            } else {
                faces.push_back({a, b, c, noVertex});
                faces.push_back({a, c, d, noVertex});
            }
        }
    return faces;
}

// Its places, with x and y in 0 … 1.
template <class Height>
std::vector<glm::dvec3> gridPlaces(std::uint32_t n, Height&& height) {
    std::vector<glm::dvec3> places;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            places.emplace_back(x, y, height(x, y));
        }
    return places;
}

constexpr float unlimited = std::numeric_limits<float>::infinity();

double flat(double, double) {
    return 0.0;
}

std::vector<glm::vec3> floats(const std::vector<glm::dvec3>& places) {
    return {places.begin(), places.end()};
}

// Quadrangles beside triangles, and a vertex in which two sheets meet.
std::vector<Face> mixedFaces() {
    std::vector<Face> faces = gridFaces(4, true);
    faces[5] = {6, 7, 12, noVertex};
    faces.push_back({6, 12, 11, noVertex});
    faces.erase(faces.begin() + 15);
    faces.erase(faces.begin() + 1);
    faces.push_back({24, 25, 26, noVertex});
    return faces;
}

TEST(ViewSubdivision, WeightsOfAPlaceAddUpToOneAndThoseOfTangentsToNothing) {
    std::vector<glm::dvec3> places = gridPlaces(4, flat);
    places.insert(places.end(), {{2, 1, 0}, {2, 2, 0}});
    for (const std::vector<Face>& faces : {gridFaces(4, true), gridFaces(4, false), mixedFaces()}) {
        const FineMesh fine = subdivided(faces, places, true, 2);
        for (const SparseRows* rows : {&fine.controls, &fine.surface})
            for (std::size_t v = 0; v < rows->count(); ++v) {
                glm::vec3 sum(0.0F);
                for (std::size_t i = rows->first[v]; i < rows->first[v + 1]; ++i) sum += rows->terms[i].weights;
                ASSERT_LT(glm::length(sum - glm::vec3(1.0F, 0.0F, 0.0F)), 1e-5F);  // 16 roundings of up to 9
            }
    }
}

TEST(ViewSubdivision, AFlatSheetStaysFlatWithItsUvWhereTheyWere) {
    std::vector<glm::dvec3> places = gridPlaces(4, [](double x, double y) { return 0.5 * x - y; });
    places.push_back(places[2]);
    std::vector<Face> slit = gridFaces(4, true);  // from the middle of the border to vertex 7
    slit[2][0] = 25;
    std::vector<glm::vec2> uv;
    for (const glm::dvec3& p : places) uv.emplace_back(p.x + p.y, 2.0 * p.y);
    const glm::vec3 normal = glm::normalize(glm::vec3(-0.5F, 1.0F, 1.0F));
    for (const std::vector<Face>& faces : {gridFaces(4, true), gridFaces(4, false), slit}) {
        const FineMesh fine = subdivided(faces, places, true, 2);
        const Geometry geometry = fine.geometry(floats(places), unlimited);
        const std::vector<glm::vec2> fineUv = fine.spread(uv);
        for (std::size_t v = 0; v < fineUv.size(); ++v) {
            const glm::vec3 p = geometry.positions[v];
            ASSERT_NEAR(p.z, 0.5F * p.x - p.y, 1e-6F);
            ASSERT_LT(glm::length(fineUv[v] - glm::vec2(p.x + p.y, 2.0F * p.y)), 2e-6F);
            if (v != 25 || faces[2][0] == 25)  // a vertex of the slit alone
                ASSERT_LT(glm::length(geometry.normals[v] - normal), 1e-5F) << v;
        }
    }
}

// The largest errors of positions and of normals on z = x² - xy + 0.3 sin 3y, away from the border.
glm::dvec2 errorsOn(std::uint32_t n, bool isWhole, int levels) {
    const auto height = [](double x, double y) { return x * x - x * y + 0.3 * std::sin(3.0 * y); };
    const std::vector<glm::dvec3> places = gridPlaces(n, height);
    Geometry geometry{floats(places), std::vector<glm::vec3>(places.size())};
    const FineMesh fine = subdivided(gridFaces(n, isWhole), places, true, 1);
    if (levels > 0) geometry = fine.geometry(floats(places), unlimited);
    if (levels == 0) {
        std::vector<std::uint32_t> triangles;
        for (const Face& face : gridFaces(n, false)) triangles.insert(triangles.end(), face.begin(), face.begin() + 3);
        smoothNormals(geometry.positions, triangles, geometry.normals);
    }
    glm::dvec2 worst(0.0);
    for (std::size_t v = 0; v < geometry.positions.size(); ++v) {
        const glm::dvec3 p(geometry.positions[v]);
        if (std::max(std::abs(p.x - 0.5), std::abs(p.y - 0.5)) > 0.26) continue;
        const glm::dvec3 normal = glm::normalize(glm::dvec3(p.y - 2.0 * p.x, p.x - 0.9 * std::cos(3.0 * p.y), 1.0));
        worst = glm::max(
            worst, glm::dvec2(std::abs(p.z - height(p.x, p.y)), glm::length(glm::dvec3(geometry.normals[v]) - normal)));
    }
    return worst;
}

// The normals of the mesh itself are of the second order.
TEST(ViewSubdivision, PlacesAndNormalsInsideAreOfTheFourthOrderOfACell) {
    for (const bool isWhole : {true, false}) {
        const glm::dvec2 coarse = errorsOn(8, isWhole, 1), fine = errorsOn(16, isWhole, 1);
        for (const double ratio : {coarse.x / fine.x, coarse.y / fine.y}) {
            EXPECT_GT(ratio, 13.0);  // 16, with terms of the sixth order and, of normals, float's rounding
            EXPECT_LT(ratio, 19.0);
        }
        EXPECT_LT(20.0 * coarse.y, errorsOn(8, isWhole, 0).y);
    }
}

TEST(ViewSubdivision, CornersStayAndTheBorderBetweenThemIsRound) {
    const std::vector<glm::dvec3> places = gridPlaces(4, flat);
    std::vector<glm::vec3> bent = floats(places);
    bent[2].z = 1.0F;  // of the border y = 0
    const FineMesh fine = subdivided(gridFaces(4, true), places, true, 1);
    const Geometry geometry = fine.geometry(bent, unlimited);
    for (const std::size_t corner : {0U, 4U, 20U, 24U}) EXPECT_EQ(geometry.positions[corner], bent[corner]);
    // A second difference by a sixth of which a spline misses its points leaves 1 - (1/9 + 2/36) of a spike.
    EXPECT_NEAR(geometry.positions[2].z, 5.0F / 6.0F, 1e-6F);
    EXPECT_NEAR(geometry.normals[2].x, 0.0F, 1e-6F);
    // Without corners they are rounded like the rest.
    const Geometry round = subdivided(gridFaces(4, true), places, false, 1).geometry(bent, unlimited);
    EXPECT_GT(glm::length(round.positions[0]), 0.01F);
}

TEST(ViewSubdivision, NoPlaceIsFurtherFromTheFlatMeshThanThereIsRoom) {
    const std::vector<glm::dvec3> places = gridPlaces(4, [](double x, double y) { return std::sin(9.0 * x) * y; });
    for (const bool isWhole : {true, false}) {
        const FineMesh fine = subdivided(gridFaces(4, isWhole), places, true, 2);
        const std::vector<glm::vec3> free = fine.geometry(floats(places), unlimited).positions;
        const std::vector<glm::vec3> held = fine.geometry(floats(places), 0.01F).positions;
        const std::vector<glm::vec3> wide = fine.geometry(floats(places), 10.0F).positions;
        std::vector<glm::vec3> lying = floats(places);  // in the triangles of the mesh
        for (const auto& [a, b] : fine.middles) lying.push_back(0.5F * (lying[a] + lying[b]));
        ASSERT_EQ(lying.size(), free.size());
        float farthest = 0.0F;
        for (std::size_t v = 0; v < free.size(); ++v) {
            farthest = std::max(farthest, glm::distance(free[v], lying[v]));
            ASSERT_LT(glm::distance(held[v], lying[v]), 0.01F);
            ASSERT_LT(glm::distance(wide[v], free[v]), 1e-6F);  // of 10 m there is room enough: roundings
        }
        EXPECT_GT(farthest, 0.1F);
        for (std::size_t v = 25; v < lying.size(); ++v) {  // x and y of a flat place are those of a grid of 16 cells
            const glm::vec2 cells(16.0F * lying[v].x, 16.0F * lying[v].y);
            ASSERT_LT(glm::distance(cells, glm::round(cells)), 1e-5F);
        }
    }
}

}  // namespace
}  // namespace taut::view::test
