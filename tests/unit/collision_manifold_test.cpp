// Contact manifolds of convex shapes against geometry: eight shapes on a slab, a hull and a lying cylinder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "collision_support.h"
#include "taut/collision/convex.h"

namespace taut::collision {
namespace {

Frame frameOf(const glm::dquat& turn, const glm::dvec3& position) {
    return {glm::mat3_cast(turn), position, true};
}

std::shared_ptr<const Convex> convexOf(const SizedShape& shape, double rounding) {
    return builtInShapes().find(shape.kind)->convex(shape, rounding);
}

struct Subject {
    std::string name;
    SizedShape shape;
    glm::dquat turn;
    double low;         // [m] of its middle over its lowest place
    int onFlat, onLog;  // places
};

// Of a size [m].
std::vector<Subject> subjects(double s) {
    const glm::dquat upright = turned({0, 1, 0}, 0.3);
    const glm::dquat lying = upright * turned({0, 0, 1}, 0.5 * core::pi);
    const double lean = std::atan(0.5);  // of a cone's side to its axis
    return {{"box", boxShape(glm::dvec3(0.5 * s)), upright, 0.5 * s, 4, 2},
            {"hull", boxHull(glm::dvec3(0.5 * s)), upright, 0.5 * s, 4, 2},
            {"standing cylinder", roundShape("cylinder", 0.5 * s, s), upright, 0.5 * s, 4, 2},
            {"lying cylinder", roundShape("cylinder", 0.5 * s, s), lying, 0.5 * s, 2, 1},
            {"standing cone", roundShape("cone", 0.5 * s, s), upright, 0.5 * s, 4, 2},
            {"lying cone", roundShape("cone", 0.5 * s, s), upright * turned({0, 0, 1}, 0.5 * core::pi + lean),
             0.5 * s * std::sin(lean), 2, 1},
            {"lying capsule", roundShape("capsule", 0.25 * s, 0.5 * s), lying, 0.25 * s, 2, 1},
            {"sphere", roundShape("sphere", 0.5 * s), upright, 0.5 * s, 1, 1}};
}

struct Ground {
    std::string name;
    SizedShape shape;
    Frame at;
    double rounding;
};

std::vector<Ground> grounds(double s) {
    const glm::dquat none = turned({0, 1, 0}, 0.0), lying = turned({0, 0, 1}, 0.5 * core::pi);
    const glm::dvec3 slab(10 * s, s, 10 * s);
    return {{"slab", boxShape(slab), frameOf(none, {0.3 * s, -s, 0.2 * s}), 0.0},
            {"hull", boxHull(slab), frameOf(none, {0.3 * s, -s, 0.2 * s}), 0.0},
            {"log", roundShape("cylinder", 0.5 * s, 10 * s), frameOf(lying, {0, -0.5 * s, 0}), 0.0}};
}

// Rounding of the shapes above, as a share of the size.
constexpr double rounding = 0.02;

TEST(Manifold, HasThePlacesAndGapsOfGeometry) {
    for (const double s : {0.005, 0.1, 50.0})
        for (const Ground& ground : grounds(s)) {
            const auto below = convexOf(ground.shape, ground.rounding);
            for (const Subject& subject : subjects(s)) {
                // A hull grows by its rounding, the others keep their size.
                const double grown = subject.shape.kind == "hull" ? rounding * s : 0.0;
                const auto above = convexOf(subject.shape, rounding * s);
                for (const double share : {-1e-3, 0.0, 1e-6, 1e-3, 5e-3}) {
                    const double gap = share * s;
                    const Frame at = frameOf(subject.turn, {0, subject.low + grown + gap, 0});
                    const Manifold found = manifoldOf(*above, at, *below, ground.at, 0.01 * s);
                    const std::string what = subject.name + " on " + ground.name + " of " + std::to_string(s) +
                                             " m, gap " + std::to_string(share);
                    const bool isLog = ground.name == "log";
                    // A log is round: places beside its ridge are further than the reach for all but edges along it.
                    EXPECT_EQ(found.count, isLog ? subject.onLog : subject.onFlat) << what;
                    double least = 1e300;
                    for (const Manifold::Place& place : found.places()) {
                        least = std::min(least, place.gap);
                        if (isLog) continue;
                        EXPECT_NEAR(place.gap, gap, 1e-12 * s) << what;
                        EXPECT_NEAR(place.onB.y, 0.0, 1e-12 * s) << what;
                    }
                    EXPECT_NEAR(least, gap, 1e-8 * s) << what;
                    EXPECT_NEAR(found.normal.y, 1.0, 1e-9) << what;
                    const Manifold swapped = manifoldOf(*below, ground.at, *above, at, 0.01 * s);
                    ASSERT_EQ(swapped.count, found.count) << what;
                    const auto isLess = [](const auto& p, const auto& q) { return p.gap < q.gap; };
                    const auto of = swapped.places();
                    EXPECT_NEAR(std::min_element(of.begin(), of.end(), isLess)->gap, least, 1e-8 * s) << what;
                }
            }
        }
}

// An edge that leans on a log, or on an edge, along its whole length: no face is across the normal.
TEST(Manifold, OfEdgesThatLieAlongEachOtherHasBothEnds) {
    const double s = 0.1, gap = 1e-3 * s;
    const glm::dquat leaning = turned({0, 0, 1}, 0.25 * core::pi), lying = turned({1, 0, 0}, 0.5 * core::pi);
    // The rounded edge reaches down by this.
    const double low = std::sqrt(0.5) * (1.0 - 2.0 * rounding) * s + rounding * s;
    const Frame at = frameOf(leaning, {0, low + gap, 0});
    const Ground log{"log", roundShape("cylinder", 0.5 * s, 10 * s), frameOf(lying, {0, -0.5 * s, 0}), 0.0};
    const Ground edge{"edge", boxShape({0.5 * s, 0.5 * s, 5 * s}), frameOf(leaning, {0, -low, 0}), rounding * s};
    for (const Ground& below : {log, edge})
        for (const SizedShape& shape : {boxShape(glm::dvec3(0.5 * s)), boxHull(glm::dvec3((0.5 - rounding) * s))}) {
            const std::string what = shape.kind + " on " + below.name;
            const Manifold found = manifoldOf(*convexOf(shape, rounding * s), at,
                                              *convexOf(below.shape, below.rounding), below.at, 0.01 * s);
            ASSERT_EQ(found.count, 2) << what;
            EXPECT_NEAR(std::abs(found.of[0].onA.z - found.of[1].onA.z), (1.0 - 2.0 * rounding) * s, 1e-12 * s) << what;
            for (const Manifold::Place& place : found.places()) EXPECT_NEAR(place.gap, gap, 1e-8 * s) << what;
        }
}

// A plane is no Bullet shape with a supporting face: each corner of a body on it has its own height.
TEST(Manifold, OnAPlaneIsItsCornersHeights) {
    const auto plane = convexOf(planeShape(), 0.0);
    const auto box = convexOf(boxShape(glm::dvec3(0.5)), 0.01);
    const double tilt = 1e-3;
    const Frame at = frameOf(turned({0, 0, 1}, tilt), {0, 0.5, 0});
    const Manifold found = manifoldOf(*box, at, *plane, frameOf(turned({0, 1, 0}, 0.0), glm::dvec3(0.0)), 0.1);
    ASSERT_EQ(found.count, 4);
    for (const Manifold::Place& place : found.places()) {
        const double side = place.onA.x > 0 ? 1.0 : -1.0;
        EXPECT_NEAR(place.gap, 0.5 + side * 0.49 * std::sin(tilt) - 0.49 * std::cos(tilt) - 0.01, 1e-14);
    }
    const Manifold from = manifoldOf(*plane, frameOf(turned({0, 1, 0}, 0.0), glm::dvec3(0.0)), *box, at, 0.1);
    EXPECT_EQ(from.normal, glm::dvec3(0.0, -1.0, 0.0));
    EXPECT_EQ(from.of[0].onB, found.of[0].onA);
}

}  // namespace
}  // namespace taut::collision
