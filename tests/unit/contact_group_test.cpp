// The result of a block depends on that block alone: not on the blocks before, nor on threads. Removed bodies
// have no contact.
#include "contact_support.h"
#include "taut/core/private/parallel.h"

namespace taut::contact {
namespace {

// A sheet of loose points over another, which is held; some of its points are pulled to and fro, and pressed down.
struct Kneading {
    Flight flight;
    int instant = 0;

    explicit Kneading(int cells = 10) {
        flight.addSheet({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, {0.0, 0.0, 0.3}, cells, dvec3(0.0), 2e-3, 0.005);
        ContactSurface& upper = flight.addSheet({0.02, 0.0102, 0.01}, {0.28, 0.0, 0.03}, {-0.03, 0.0, 0.28}, cells,
                                                {0.1, 0.0, 0.05}, 1e-3, 0.005);
        upper.meetsItself = true;
        for (std::size_t i = 0; i < flight.x.size() / 2; ++i) flight.inverseMass[i] = i % 3 == 0 ? 0.0 : 500.0;
    }
    // Springs of a kind to where the points began, and a swing.
    void next(double h) {
        if (start_.empty()) start_ = flight.x;
        ++instant;
        const double phase = 0.05 * instant;
        for (std::size_t i = 0; i < flight.x.size(); ++i) {
            if (!(flight.inverseMass[i] > 0)) continue;
            const bool isUpper = i >= flight.x.size() / 2;
            // A polynomial, not sin, so that all machines agree.
            const double saw = phase - 2 * std::floor(0.5 * phase), swing = saw * (2 - saw) * (1 - saw);
            dvec3 force = 400.0 * (start_[i] - flight.x[i]) - 2.0 * flight.v[i];
            if (isUpper)
                force += dvec3(0.0, (i % 7 == 0 ? -90.0 : -9.81) + 200.0 * swing, i % 5 == 0 ? 20.0 * swing : 0.0);
            flight.v[i] += h * force;
        }
        flight.fly(h);
    }

  private:
    std::vector<dvec3> start_;
};

TEST(ContactGroup, GivesTheSameBitsAsOneThatForgetsAllInEachBlock) {
    for (const double h : {2.5e-4, 1e-3}) {
        Kneading lasting, anew;
        std::size_t met = 0;
        for (int i = 0; i < 400; ++i) {
            lasting.next(h);
            anew.next(h);
            anew.flight.group->drop();
            met += lasting.flight.group->activeCount() > 0 ? 1 : 0;
            ASSERT_EQ(lasting.flight.x, anew.flight.x) << "instant " << i << " of " << h << " s";
            ASSERT_EQ(lasting.flight.v, anew.flight.v) << "instant " << i << " of " << h << " s";
        }
        EXPECT_GT(met, 50U);
    }
}

TEST(ContactGroup, GivesTheSameBitsWithAnyNumberOfThreads) {
    std::vector<std::vector<dvec3>> found;
    for (const int threads : {1, 2, 7}) {
        core::ThreadLimit limit(threads);
        limit.run([&] {
            Kneading kneading(16);
            for (int i = 0; i < 60; ++i) kneading.next(1e-3);
            found.push_back(kneading.flight.x);
        });
    }
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
}

// A pair that went away and came back.
TEST(ContactGroup, MeetsWhatWentAwayAndCameBack) {
    Flight flight;
    flight.addBall({0.0, 0.0101, 0.0}, {0.0, 1.0, 0.0}, 0.01, 0.005);
    flight.addTriangle({dvec3(-1, 0, -1), dvec3(1, 0, -1), dvec3(0, 0, 2)}, dvec3(0.0), 0.0, 0.005);
    for (int i = 0; i < 30; ++i) {
        if (i == 3) flight.v[0].y = -1.0;  // 3 mm away
        flight.fly(1e-3);
        EXPECT_GE(flight.x[0].y, 0.01 - 1e-12) << i;
    }
}

// A corner of a sheet that a ball pushes at another, and that is braked each time before: it goes only where contact
// leads it.
TEST(ContactGroup, MeetsWhatContactLeadsToIt) {
    Flight flight;
    flight.addSheet({-0.2, 0.0, -0.2}, {0.2, 0, 0}, {0, 0, 0.2}, 2, dvec3(0.0), 0.01, 0.005);
    const std::size_t corner = 8;  // at the origin
    flight.addBall({0.0, -0.0101, 0.0}, {0.0, 1.0, 0.0}, 0.0, 0.005);
    flight.addBall({0.0, 0.027, 0.0}, dvec3(0.0), 0.1, 0.005);
    for (int i = 0; i < 60; ++i) {
        for (std::size_t k = 0; k < 9; ++k) flight.v[k] = dvec3(0.0);
        flight.fly(1e-3);
        EXPECT_GT(flight.x[10].y - flight.x[corner].y, 0.009) << i;
    }
}

// A ball that another hits from the side at 100 m/s, aslant by 45°: equal masses share the 71 m/s along the normal, so
// that it goes down at 25 m/s, by 25 mm in this instant. Nothing came near the ground 20 mm below it before.
TEST(ContactGroup, MeetsWhatAnImpulseLeadsFarInOneInstant) {
    for (const bool hasGround : {true, false}) {
        Flight flight;
        flight.options.friction = 0;
        flight.addBall({0.0, 0.02, 0.0}, dvec3(0.0), 0.01, 0.001);
        flight.addBall({-std::sqrt(2e-6), 0.02 + std::sqrt(2e-6), 0.0}, {100.0, 0.0, 0.0}, 0.01, 0.001);
        if (hasGround) flight.addTriangle({dvec3(-1, 0, -1), dvec3(1, 0, -1), dvec3(0, 0, 2)}, dvec3(0.0), 0.0, 0.001);
        flight.fly(1e-3);
        // Of the 20 mm at the start a fifth is left.
        EXPECT_NEAR(flight.x[0].y, hasGround ? 0.004 : -0.005, 1e-9);
    }
}

// A ball comes through a triangle of which two corners are held, right beside them: of 0.9 % of the squares of the
// weights the third is not pressed. The certificate slides it down, and up again from the sheet 30 mm below it, to
// which nothing else is near: a fifth of that is left. All in powers of two there, for which of the corners goes down
// is left to rounding.
TEST(ContactGroup, MeetsWhatASlideLeadsToIt) {
    Flight flight;
    flight.addTriangle({dvec3(0, 0, 1), dvec3(-1, 0, 0), dvec3(1, 0, 0)}, dvec3(0.0), 0.01, 0.002);
    flight.inverseMass[1] = flight.inverseMass[2] = 0;
    flight.addTriangle({dvec3(-2, -0.03, 0.2), dvec3(2, -0.03, 0.2), dvec3(0, -0.03, 4)}, dvec3(0.0), 0.0, 0.002);
    flight.addBall({0.0, 1.0 / 32, 1.0 / 16}, {0.0, -100.0, 0.0}, 0.0, 0.002);
    EXPECT_EQ(flight.fly(1e-3).impulses, 0);
    EXPECT_NEAR(flight.x[0].y, -0.024, 1e-9);
}

// A hole of triangles that are gone; a ball goes through it, and is kept elsewhere.
TEST(ContactGroup, LetsThroughWhereTrianglesAreGone) {
    for (const bool hasHole : {false, true}) {
        Flight flight;
        flight.addSheet({-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 4, dvec3(0.0), 0.0, 0.005);
        flight.addBall({0.05, 0.03, 0.05}, {0.0, -2.0, 0.0}, 0.1, 0.005);
        flight.addBall({-0.15, 0.03, 0.0}, {0.0, -2.0, 0.0}, 0.1, 0.005);
        flight.fly(1e-4);
        if (hasHole) {
            // Both triangles of the square (2, 2), and the space between them.
            flight.group->elements().setGone(
                0, [](std::size_t t) { return t / 2 == 2 * 4 + 2; }, [](int a, int b) { return a == 13 && b == 17; });
            flight.group->elements().refresh();
            flight.group->drop();
        }
        for (int i = 0; i < 60; ++i) flight.fly(1e-3);
        EXPECT_EQ(flight.x[25].y < -0.05, hasHole);
        EXPECT_NEAR(flight.x[26].y, 0.01, 1e-9);
    }
}

// A point of which all triangles are gone, and all edges severed, is a ball: it is met and meets.
TEST(ContactGroup, LeavesBallsWhereAllIsGone) {
    Flight flight;
    flight.addSheet({-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 4, dvec3(0.0), 0.0, 0.005);
    flight.addBall({0.0, 0.05, 0.0}, {0.0, -2.0, 0.0}, 0.1, 0.005);   // over the point in the middle
    flight.addBall({0.05, 0.05, 0.0}, {0.0, -2.0, 0.0}, 0.1, 0.005);  // over an edge that is not there any more
    flight.fly(1e-4);
    flight.group->elements().setGone(
        0, [](std::size_t) { return true; }, [](int, int) { return true; });
    flight.group->elements().refresh();
    flight.group->drop();
    for (int i = 0; i < 60; ++i) flight.fly(1e-3);
    EXPECT_NEAR(flight.x[25].y, 0.01, 1e-9);
    EXPECT_LT(flight.x[26].y, -0.05);
}

// Two triangles born through each other: led apart, they end without a crossing and with the momentum they had.
TEST(ContactGroup, LeadsApartWhatIsCrossed) {
    const auto crossingsAfter = [](bool untangles) {
        Flight flight;
        flight.options.untangles = untangles;
        flight.addSheet({-0.1, 0.0, -0.1}, {0.2, 0, 0}, {0, 0, 0.2}, 4, dvec3(0.0), 1e-3, 0.002);
        flight.addTriangle({dvec3(0.013, 0.03, 0.011), dvec3(-0.017, 0.03, 0.012), dvec3(0.003, -0.006, 0.007)},
                           dvec3(0.0), 1e-3, 0.002);
        const test::Skin skin = flight.skin();
        EXPECT_GT(countPiercings(skin, flight.x), 0);
        for (int i = 0; i < 300 && countPiercings(skin, flight.x) > 0; ++i) {
            flight.fly(1e-3);
            if (i % 10 == 9) flight.group->begin(flight.x);
        }
        EXPECT_LT(glm::length(flight.momentum()), 1e-15);
        return countPiercings(skin, flight.x);
    };
    EXPECT_EQ(crossingsAfter(true), 0);
    EXPECT_GT(crossingsAfter(false), 0);
}

// Two triangles go through a third. Once the one is led out it is pressed as anything else, though the other is still
// crossed: of 2 m/s a gap of 0.5 mm leaves 0.5 m/s in a millisecond.
TEST(ContactGroup, PressesWhatIsNotCrossedAnyMore) {
    Flight flight;
    flight.addTriangle({dvec3(-3, 0, -3), dvec3(3, 0, -3), dvec3(0, 0, 3)}, dvec3(0.0), 0.0, 0.002);
    for (const double side : {-0.5, 0.5})
        flight.addTriangle({dvec3(side, -0.01, 0), dvec3(side - 0.05, 0.1, 0.01), dvec3(side + 0.05, 0.1, -0.01)},
                           dvec3(0.0), 0.01, 0.002);
    const std::vector<dvec3> start = flight.x;
    flight.fly(1e-4);
    const std::size_t crossings = flight.group->crossings().size();
    flight.x = start;
    for (std::size_t i = 3; i < 6; ++i) {
        flight.x[i].y += 0.0145;
        flight.v[i] = {0.0, -2.0, 0.0};
    }
    flight.group->drop();
    flight.group->begin(flight.x);
    EXPECT_EQ(2 * flight.group->crossings().size(), crossings);
    flight.fly(1e-3);
    EXPECT_NEAR(flight.v[3].y, -0.5, 1e-9);
}

// Right through the middle of another, along a straight line: of the sheet that is parted the smaller part goes back,
// straight through the other.
TEST(ContactGroup, LeadsTheSmallerPartOfASheetBack) {
    for (const double below : {0.055, 0.145}) {  // [m] of 0.2
        Flight flight;
        flight.addSheet({-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 4, dvec3(0.0), 1e-3, 0.002);
        flight.addSheet({-0.103, -below, 0.013}, {0.2, 0, 0.01}, {0, 0.2, 0.02}, 4, dvec3(0.0), 1e-3, 0.002);
        const Elements elements(flight.surfaces, flight.x);
        Bvh bvh(elements);
        const std::vector<Crossing> crossings = findCrossings(elements, bvh, flight.x);
        EXPECT_GE(crossings.size(), 12U);  // 9 edges of the parted, and some of the other
        for (const Crossing& crossing : crossings) {
            const bool isParted = elements.edges()[crossing.edge].surface == 1;
            EXPECT_NEAR(crossing.separatingDirection.y, isParted == (below < 0.1) ? 1.0 : -1.0, 1e-12);
        }
    }
}

// After a certified tick no crossing is looked for where the points still are where it left them. One that was moved
// since may cross, whoever moved it.
TEST(ContactGroup, LooksForCrossingsWherePointsWereMovedFromOutside) {
    Flight flight;
    flight.addTriangle({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0, 0, 2)}, dvec3(0.0), 1.0, 0.005);
    flight.addTriangle({dvec3(0.0, 0.1, 0.5), dvec3(0.02, 1.0, 0.51), dvec3(-0.02, 1.0, 0.5)}, dvec3(0.0), 1.0, 0.005);
    EXPECT_EQ(flight.fly(1e-4).uncertified, 0);
    flight.group->begin(flight.x);
    EXPECT_TRUE(flight.group->crossings().empty());
    flight.x[3].y = -0.1;
    for (int again = 0; again < 2; ++again) {
        flight.group->begin(flight.x);
        EXPECT_EQ(flight.group->crossings().size(), 2U);
    }
}

// A held edge through a triangle: of which one corner is free, far from where the edge goes through, or all are and
// come at it at 50 m/s. In an instant a crossing makes no point faster by more than 0.3 m/s.
TEST(ContactGroup, LeadsNoPointApartFasterThanFromRest) {
    for (const bool isHeld : {true, false}) {
        Flight flight;
        flight.addTriangle({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0, 0, 2)}, dvec3(0.0, isHeld ? 0.0 : 50.0, 0.0), 1.0,
                           0.005);
        if (isHeld) flight.inverseMass[0] = flight.inverseMass[1] = 0;
        flight.addTriangle({dvec3(0.0, -0.1, 0.5), dvec3(0.02, 1.0, 0.51), dvec3(-0.02, 1.0, 0.5)}, dvec3(0.0), 0.0,
                           0.005);
        const std::vector<dvec3> before = flight.v;
        flight.fly(1e-4);
        EXPECT_FALSE(flight.group->crossings().empty());
        double most = 0;
        for (std::size_t i = 0; i < 3; ++i) most = std::max(most, glm::length(flight.v[i] - before[i]));
        EXPECT_GT(most, 0.1);
        EXPECT_LT(most, 2 * 0.3 + 1e-9);  // of two edges that go through
    }
}

}  // namespace
}  // namespace taut::contact
