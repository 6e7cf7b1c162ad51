// Edges and faces near shapes against a search over all of their places.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "collision_support.h"
#include "taut/collision/element_distance.h"

namespace taut::collision {
namespace {

// The least value of a function that has one minimum in 0 … 1, by golden sections.
template <class Function>
double least(const Function& f) {
    constexpr double golden = 0.6180339887498949;
    double low = 0, high = 1, left = 1 - golden, right = golden, atLeft = f(left), atRight = f(right);
    for (int k = 0; k < 60; ++k) {
        if (atLeft < atRight) {
            high = right;
            right = left;
            atRight = atLeft;
            atLeft = f(left = high - golden * (high - low));
        } else {
            low = left;
            left = right;
            atLeft = atRight;
            atRight = f(right = low + golden * (high - low));
        }
    }
    return std::min({atLeft, atRight, f(0.0), f(1.0)});
}

std::vector<SizedShape> shapes() {
    return {boxShape({0.3, 0.2, 0.5}), roundShape("sphere", 0.4), roundShape("capsule", 0.2, 0.6),
            roundShape("cylinder", 0.3, 0.8), roundShape("cone", 0.3, 0.8)};
}

// The nearest of corners, edges and face is the nearest place of the triangle, 1e-7 m of a metre, and a triangle that
// goes through a shape between its corners is below 0. An edge is level, and has no place of its own, where the
// distance falls from an end by less than 1e-3 of the way: by that it may come nearer.
TEST(ElementDistance, OfATriangleIsThatOfItsNearestPlace) {
    Numbers numbers;
    for (const SizedShape& sized : shapes()) {
        const auto shape = builtInShapes().find(sized.kind)->convex(sized, 0.0);
        const ClosedShape closed = shape->closed();
        int apart = 0, pierced = 0;
        for (int trial = 0; trial < 1500; ++trial) {
            const glm::dvec3 middle = numbers.point(0.7);
            glm::dvec3 x[3];
            Nearest at[3];
            double found = 1e300, allowed = 1e-7;
            for (int k = 0; k < 3; ++k) {
                x[k] = middle + numbers.point(0.3);
                at[k] = distanceTo(closed, x[k]);
                found = std::min(found, at[k].distance);
            }
            for (int k = 0; k < 3; ++k) {
                const int next = (k + 1) % 3;
                if (const auto edge = nearestInEdge(closed, x[k], x[next], at[k], at[next]))
                    found = std::min(found, edge->distance);
                const glm::dvec3 way = x[next] - x[k];
                const double level = 1e-3 * glm::length(way);
                const double fall = std::min(-glm::dot(at[k].normal, way), glm::dot(at[next].normal, way));
                if (fall > 0 && fall <= level) allowed = level;
            }
            if (found > 0)  // else corners or edges are in it
                if (const auto face = nearestInFace(*shape, x[0], x[1], x[2])) found = std::min(found, face->distance);
            const double truth = least([&](double p) {
                return least([&](double q) {
                    const glm::dvec3 place = x[0] + p * ((1 - q) * (x[1] - x[0]) + q * (x[2] - x[0]));
                    return std::max(distanceTo(closed, place).distance, 0.0);
                });
            });
            if (truth > 1e-6) {
                ++apart;
                EXPECT_NEAR(found, truth, allowed) << sized.kind << ' ' << trial;
            } else {
                ++pierced;
                EXPECT_LT(found, 1e-6) << sized.kind << ' ' << trial;
            }
        }
        EXPECT_GT(std::min(apart, pierced), 100) << sized.kind;
    }
}

// Deep in a shape two sides are equally near. Through a corner an edge is pushed across itself, through a plate to a
// side.
TEST(ElementDistance, OfAnEdgeThroughAShapePushesItOut) {
    const auto nearest = [](const glm::dvec3& half, const glm::dvec3& a, const glm::dvec3& b) {
        const ClosedShape box = builtInShapes().find("box")->convex(boxShape(half), 0.0)->closed();
        return *nearestInEdge(box, a, b, distanceTo(box, a), distanceTo(box, b));
    };
    const ElementNear corner = nearest(glm::dvec3(0.5), {0.2, 0.7, 0.0}, {0.7, 0.2, 0.0});
    EXPECT_NEAR(corner.distance, -0.05, 1e-9);
    EXPECT_NEAR(glm::length(corner.normal - std::sqrt(0.5) * glm::dvec3(1.0, 1.0, 0.0)), 0.0, 1e-9);
    const ElementNear plate = nearest({0.5, 0.01, 0.5}, {0.0, 0.3, 0.0}, {0.01, -0.3, 0.0});
    EXPECT_EQ(std::abs(plate.normal.y), 1.0);
}

}  // namespace
}  // namespace taut::collision
