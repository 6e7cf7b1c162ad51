// Corners and edges of rigid surfaces in a group: impulses by hand, and how far they stand out.
#include "contact_support.h"
#include "taut/contact/penetration.h"

namespace taut::contact {
namespace {

// A triangle of three points of 1 kg, in the plane y = 0, and rigid edges from the first of the points to others.
struct Scene {
    std::vector<dvec3> x{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    ContactSurface sheet, rigid;

    Scene() {
        sheet.points = {0, 1, 2};
        sheet.triangles = {{0, 1, 2}};
        sheet.thickness = 0.01;
        rigid.isRigid = true;
        rigid.meetsItself = rigid.meetsOthers = false;
        rigid.thickness = 0;
        rigid.bond = 1;
    }
    int add(const dvec3& place) {
        x.push_back(place);
        return static_cast<int>(x.size()) - 1;
    }
    // A pyramid upside down without its base would be the solid: its tip, and three edges that lead down.
    void addTip(const dvec3& tip) {
        const int top = add(tip), first = add(tip + dvec3(-0.5, -0.5, -0.3)),
                  second = add(tip + dvec3(0.5, -0.5, -0.3)), third = add(tip + dvec3(0, -0.5, 0.6));
        rigid.points = {top, first, second, third};
        rigid.lines = {{top, first}, {top, second}, {top, third}};
        rigid.wings = {{second, third}, {third, first}, {first, second}};
    }
    ContactGroup group() const {
        ContactOptions options;
        return ContactGroup({sheet, rigid}, x, options);
    }
};

std::vector<double> masses(const Scene& scene) {
    std::vector<double> inverse(scene.x.size(), 0.0);
    for (std::size_t i = 0; i < 3; ++i) inverse[i] = 1.0;
    return inverse;
}

// Weights 1/3 each make 3 kg; a surface at rest may come as near as the gap g lets it within the instant h.
TEST(ContactFaces, ATriangleIsStoppedByATipAsItsWholeMass) {
    constexpr double gap = 0.0005, h = 1e-3, speed = 2.0, rise = 0.25;
    Scene scene;
    scene.addTip({0, -0.01 - gap, -1.0 / 3});
    ContactGroup group = scene.group();
    std::vector<dvec3> x0 = scene.x, x1 = x0, v(x0.size(), dvec3(0.0));
    for (std::size_t i = 0; i < x0.size(); ++i) {
        v[i] = i < 3 ? dvec3(0, -speed, 0) : dvec3(0, rise, 0);
        x1[i] += h * v[i];
    }
    const std::vector<dvec3> before = x1;
    const std::vector<double> inverse = masses(scene);
    EXPECT_EQ(resolve(group, h, x0, x1, v, inverse).impulses, 1);
    double momentum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        momentum += v[i].y;
        EXPECT_NEAR(v[i].y, rise - gap / h, 1e-12);
        EXPECT_NEAR(x1[i].y, x0[i].y + h * rise - gap, 1e-15);
    }
    EXPECT_NEAR(momentum - 3 * -speed, 3 * (speed + rise - gap / h), 1e-12);
    for (std::size_t i = 3; i < x1.size(); ++i) EXPECT_EQ(x1[i], before[i]);
}

// Of 2 m/s that it comes down with, μ 2 m/s of its sliding speed; μ is the product of the two factors alone, for any
// friction between the bodies of the group.
TEST(ContactFaces, ATipHasTheFrictionOfItselfAndTheBody) {
    constexpr double h = 1e-4, speed = 2.0, slide = 3.0;
    Scene scene;
    scene.addTip({0, -0.01, -1.0 / 3});
    scene.sheet.friction = 0.5;
    scene.rigid.friction = 0.4;
    ContactOptions options;
    options.friction = 0.7;
    ContactGroup group({scene.sheet, scene.rigid}, scene.x, options);
    std::vector<dvec3> x1 = scene.x, v(x1.size(), dvec3(0.0));
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = {slide, -speed, 0};
        x1[i] += h * v[i];
    }
    const std::vector<double> inverse = masses(scene);
    EXPECT_EQ(resolve(group, h, scene.x, x1, v, inverse).impulses, 1);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i].x, slide - 0.5 * 0.4 * speed, 1e-12);
}

TEST(ContactFaces, ATipStandsOutByItsHeightOverTheTriangle) {
    constexpr double height = 0.03;
    Scene scene;
    scene.addTip({0, height, -1.0 / 3});
    ContactGroup group = scene.group();
    const auto heightOf = [&] {
        return penetrationOf(group.elements(), group.crossingsAt(scene.x), scene.x, [](int s) { return s == 0; });
    };
    EXPECT_EQ(group.crossingsAt(scene.x).size(), 3u);
    EXPECT_NEAR(heightOf(), height, 1e-15);
    for (dvec3& x : scene.x) x = {x.x, x.y + (&x - scene.x.data() < 3 ? 1.01 * height : 0.0), x.z};
    EXPECT_EQ(heightOf(), 0.0);
}

// The ridge of a roof goes through the two sides of a valley, and is out between: over the planes y = d (|x| - 1), at
// x = 0, by half of d cos φ, tan φ = d.
TEST(ContactFaces, ARidgeStandsOutByTheHeightOverTwoTriangles) {
    constexpr double d = 0.2;
    Scene scene;
    scene.x = {{0, -d, -1}, {0, -d, 1}, {-1, 0, 0}, {1, 0, 0}};
    scene.sheet.points = {0, 1, 2, 3};
    scene.sheet.triangles = {{0, 1, 2}, {1, 0, 3}};
    const int a = scene.add({-0.8, -d / 2, 0}), b = scene.add({0.8, -d / 2, 0});
    scene.rigid.points = {a, b};
    scene.rigid.lines = {{a, b}};
    scene.rigid.wings = {{scene.add({0, -1, -1}), scene.add({0, -1, 1})}};
    ContactGroup group = scene.group();
    EXPECT_NEAR(penetrationOf(group.elements(), group.crossingsAt(scene.x), scene.x, [](int s) { return s == 0; }),
                0.5 * d / std::sqrt(1 + d * d), 1e-15);
}

// Towards its end, at a height that it keeps anyway: the plane that stands on the edge would take a part of 5 m/s.
TEST(ContactFaces, AnEdgeDoesNotStopWhatComesAlongAFaceBesideIt) {
    constexpr double height = 0.0104, before = 0.003, h = 1e-3, speed = 5.0;
    Scene scene;
    scene.x = {{-1, height, -before}, {1, height, -before}, {0, height, -1}};
    const int a = scene.add({-2, 0, 0}), b = scene.add({2, 0, 0});
    scene.rigid.points = {a, b};
    scene.rigid.lines = {{a, b}};
    const int top = scene.add({0, 0, -1}), side = scene.add({0, -1, 0});
    scene.rigid.wings = {{top, side}};
    ContactGroup group = scene.group();
    std::vector<dvec3> x1 = scene.x, v(x1.size(), dvec3(0.0));
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = {0, 0, speed};
        x1[i] += h * v[i];
    }
    const std::vector<double> inverse = masses(scene);
    EXPECT_EQ(resolve(group, h, scene.x, x1, v, inverse).impulses, 0);
    EXPECT_EQ(v[0].z, speed);
}

TEST(ContactFaces, SurfacesForRigidOnesMeetNeitherThemselvesNorOthers) {
    Scene scene;
    scene.addTip({0, -1, 0});
    scene.sheet.meetsItself = scene.sheet.meetsOthers = false;
    ContactSurface other = scene.sheet, stopped = scene.sheet;
    other.meetsOthers = true;
    stopped.meetsRigid = false;
    const Elements elements({scene.sheet, scene.rigid, other, stopped}, scene.x);
    EXPECT_TRUE(elements.mayMeet(0, 1));
    EXPECT_TRUE(elements.mayMeet(1, 2));
    EXPECT_FALSE(elements.mayMeet(1, 3));
    EXPECT_FALSE(elements.mayMeet(1, 1));
    EXPECT_FALSE(elements.mayMeet(0, 0));
    EXPECT_FALSE(elements.mayMeet(0, 2));
}

}  // namespace
}  // namespace taut::contact
