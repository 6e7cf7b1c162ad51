// The closed kernels of points against Bullet's GJK and EPA, which are asked about the same Bullet shapes.
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "collision_support.h"
#include "taut/collision/private/bullet_convex.h"

namespace taut::collision {
namespace {

// [m] Signed.
double bulletsDistance(const Convex& shape, const dvec3& p) {
    const btSphereShape point(0.0);
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver penetration;
    btGjkPairDetector detector(&point, shape.bullet(), &simplex, &penetration);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = btTransform(btMatrix3x3::getIdentity(), toBullet(p));
    input.m_transformB = btTransform(btMatrix3x3::getIdentity(), toBullet(shape.offset()));
    btPointCollector found;
    detector.getClosestPoints(input, found, nullptr);
    return found.m_hasResult ? found.m_distance / Convex::unit : HUGE_VAL;
}

// A place in and around the box of a shape: anywhere, on a side of it, on an edge, at a corner.
dvec3 placeAround(const core::Aabb& box, bool isRound, Numbers& numbers) {
    const dvec3 at = 1.6 * numbers.point(1.0);
    dvec3 place = at;
    for (int k = 0; k < 3; ++k) {
        const double choice = numbers.point(1.0).x;
        if (choice > 0.4) place[k] = choice > 0.7 ? 1.0 : -1.0;
    }
    if (isRound && (place.x * place.x == 1.0 || place.z * place.z == 1.0)) {
        const double rho = std::sqrt(at.x * at.x + at.z * at.z);
        place.x = at.x / rho;
        place.z = at.z / rho;
    }
    return box.centre() + place * box.halfSize();
}

// Largest difference of a kernel from Bullet's answer, relative to the size. Rounding is below 4e-16 for shapes of flat
// faces, whose simplex ends exactly, and for balls, which Bullet has as points and lines with a margin.
struct Kernel {
    SizedShape shape;
    double outside;
    bool areDepthsExact;
};

std::vector<Kernel> kernels(double s, Numbers& numbers) {
    constexpr double rounding = 1e-15;
    // On a curved rim GJK goes on until a step gains less than 1e-12 of the square of the distance, so that 1e-6 of the
    // distance may be missing; 1.7e-7 of the size are.
    constexpr double onRim = 3e-7;
    SizedShape hull;
    hull.kind = "hull";
    for (int i = 0; i < 40; ++i) hull.vertices.push_back(0.4 * s * glm::normalize(numbers.point(1.0)));
    return {{boxShape(0.5 * s * dvec3(0.6, 0.4, 1.0)), rounding, true},
            {roundShape("sphere", 0.5 * s), rounding, true},
            {roundShape("capsule", 0.3 * s, 0.8 * s), rounding, true},
            {hull, rounding, true},
            {roundShape("cone", 0.3 * s, 0.8 * s), rounding, false},
            {roundShape("cylinder", 0.3 * s, 0.8 * s), onRim, false}};
}

// EPA puts up to 128 corners on a curved side. In and on a cylinder or a cone it is off by 3e-6 of the size; in one of
// 50 m by a fifth of the size, in every twentieth place or more. There the supporting plane of Bullet's shape holds the
// kernel: across the kernel's normal it is at the kernel's distance. It is so at all places.
TEST(CollisionClosedKernels, AreAsExactAsBulletsAnswers) {
    constexpr int places = 33334;  // 1e5 of each kernel
    constexpr double supported = 5e-15;
    for (const double s : {0.005, 0.1, 50.0}) {
        Numbers numbers;
        for (const Kernel& kernel : kernels(s, numbers)) {
            const std::string& kind = kernel.shape.kind;
            const std::shared_ptr<const Convex> shape = builtInShapes().find(kind)->convex(kernel.shape, 0.0);
            const std::shared_ptr<const Form> form = shape->form();
            const double margin = shape->rounding();
            double outside = 0, inside = 0, plane = 0;
            for (int i = 0; i < places; ++i) {
                const dvec3 p = placeAround(*shape->bounds(), !kernel.areDepthsExact, numbers);
                const Nearest own = form->nearest(p);
                plane = std::max(
                    plane, std::abs(glm::dot(own.normal, p - shape->support(own.normal)) - margin - own.distance));
                double& most = own.distance > 1e-6 * s ? outside : inside;
                if (&most == &outside || kernel.areDepthsExact)
                    most = std::max(most, std::abs(own.distance - bulletsDistance(*shape, p)));
            }
            EXPECT_LT(outside, kernel.outside * s) << kind << ' ' << s;
            EXPECT_LT(inside, 1e-15 * s) << kind << ' ' << s;
            EXPECT_LT(plane, supported * s) << kind << ' ' << s;
        }
    }
}

}  // namespace
}  // namespace taut::collision
