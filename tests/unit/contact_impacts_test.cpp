// Impacts of points, edges and sheets that nothing else moves, against the conservation of momentum and energy.
#include "contact_support.h"
#include "taut/contact/certificate.h"

namespace taut::contact {
namespace {

constexpr double pi = 3.14159265358979323846;

// One step, of points that are all at the origin.
void solveOnce(ContactSolver& solver, SolverBlock block, std::span<dvec3> u, std::span<dvec3> v,
               std::span<dvec3> shift) {
    const std::vector<dvec3> x(u.size(), dvec3(0.0));
    block.x = x;
    solver.begin(block);
    solver.step(x, std::vector<dvec3>(u.begin(), u.end()), u, v);
    solver.findShift(shift);
    solver.end();
}

// A point of m1 against the middle of a triangle of m2 in three equal corners: the effective mass of the triangle there
// is m2.
Flight pointOnTriangle(double m1, double m2, double speed) {
    Flight flight;
    flight.addBall({0.0, 0.02, 0.0}, {0.0, -speed, 0.0}, m1, 0.004);
    flight.addTriangle({dvec3(0.0, 0.0, 0.1), dvec3(0.1 * std::sin(2 * pi / 3), 0.0, 0.1 * std::cos(2 * pi / 3)),
                        dvec3(0.1 * std::sin(4 * pi / 3), 0.0, 0.1 * std::cos(4 * pi / 3))},
                       dvec3(0.0), m2 / 3, 0.004);
    return flight;
}

// Crossed at right angles in their middles.
Flight edgeOnEdge(double m1, double m2, double speed) {
    Flight flight;
    flight.addLine({-0.1, 0.02, 0.0}, {0.1, 0.02, 0.0}, {0.0, -speed, 0.0}, m1 / 2, 0.004);
    flight.addLine({0.0, 0.0, -0.1}, {0.0, 0.0, 0.1}, dvec3(0.0), m2 / 2, 0.004);
    return flight;
}

// Two masses on a line, restitution e: v1 = (m1 - e m2)/(m1 + m2) v, v2 = (1 + e) m1/(m1 + m2) v.
TEST(ContactImpact, SharesTheSpeedByMassAndRestitution) {
    for (const bool areEdges : {false, true})
        for (const double m2 : {0.2, 0.7})
            for (const double e : {0.0, 0.5, 1.0}) {
                SCOPED_TRACE(std::to_string(areEdges) + ", m2 " + std::to_string(m2) + ", e " + std::to_string(e));
                const double m1 = 0.2, speed = 3.0;
                Flight flight = areEdges ? edgeOnEdge(m1, m2, speed) : pointOnTriangle(m1, m2, speed);
                flight.options.restitution = e;
                flight.options.solver.restSpeed = 1e-3;
                for (int i = 0; i < 40; ++i) flight.fly(5e-4);  // on the way for 4 ms
                const std::size_t firstOfSecond = areEdges ? 2 : 1;
                for (std::size_t i = 0; i < flight.v.size(); ++i) {
                    const double ought = i < firstOfSecond ? (m1 - e * m2) / (m1 + m2) : (1 + e) * m1 / (m1 + m2);
                    EXPECT_NEAR(flight.v[i].y, -ought * speed, 1e-6 * speed) << i;
                    EXPECT_NEAR(flight.v[i].x, 0.0, 1e-12);
                    EXPECT_NEAR(flight.v[i].z, 0.0, 1e-12);
                }
            }
}

// Slower than restSpeed it stays where it comes: m1/(m1 + m2) v.
TEST(ContactImpact, OfWhatIsSlowHasNoRestitution) {
    Flight flight = pointOnTriangle(0.2, 0.6, 0.5);
    flight.options.restitution = 1.0;
    flight.options.solver.restSpeed = 1.0;
    for (int i = 0; i < 60; ++i) flight.fly(5e-4);  // on the way for 24 ms
    for (const dvec3& v : flight.v) EXPECT_NEAR(v.y, -0.25 * 0.5, 1e-6);
}

// Off the middle: 1/m = 1/m1 + (α² + β² + γ²)/m of a corner; the impulse (1 + e) m v is shared as α, β, γ.
TEST(ContactImpact, TurnsATriangleAsTheLeversSay) {
    const std::array<double, 3> shares{0.6, 0.3, 0.1};
    const std::array<dvec3, 3> corners{dvec3(0.0), dvec3(0.0, 0.0, 0.2), dvec3(0.2, 0.0, 0.0)};
    dvec3 above(0.0, 0.009, 0.0);
    double inverse = 1.0 / 0.1;
    for (std::size_t k = 0; k < 3; ++k) {
        above += shares[k] * corners[k];
        inverse += shares[k] * shares[k] / 0.5;
    }
    Flight flight;
    flight.addBall(above, {0.0, -2.0, 0.0}, 0.1, 0.004);
    flight.addTriangle(corners, dvec3(0.0), 0.5, 0.004);
    flight.options.restitution = 1.0;
    flight.options.solver.restSpeed = 1e-3;
    flight.fly(1e-3);
    const double impulse = 2 * 2.0 / inverse;
    EXPECT_NEAR(flight.v[0].y, -2.0 + impulse / 0.1, 1e-12);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(flight.v[1 + k].y, -shares[k] * impulse / 0.5, 1e-12);
}

// Two sheets of loose points, turned and shifted against each other, that meet at 4 m/s.
Flight twoSheets(double friction) {
    Flight flight;
    flight.options.friction = friction;
    flight.addSheet({0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, {0.0, 0.0, 0.3}, 6, {0.0, 2.0, 0.0}, 1e-3, 0.004);
    flight.addSheet({0.03, 0.012, 0.02}, {0.27, 0.01, 0.1}, {-0.1, 0.01, 0.27}, 6, {0.3, -2.0, 0.1}, 2e-3, 0.004);
    return flight;
}

// Every impulse acts on both sides alike. Of 2e-13 about half is the rounding of the sums of the test.
TEST(ContactImpact, KeepsLinearMomentum) {
    Flight flight = twoSheets(0.3);
    const dvec3 before = flight.momentum();
    double scale = 0;
    for (std::size_t i = 0; i < flight.v.size(); ++i) scale += flight.mass(i) * glm::length(flight.v[i]);
    const double start = flight.kinetic();
    for (int i = 0; i < 60; ++i) flight.fly(5e-4);
    EXPECT_LT(flight.kinetic(), 0.9 * start);  // they met
    EXPECT_LT(glm::length(flight.momentum() - before), 1e-13 * scale);
}

// Along the way between the places that touch an impulse has no moment; only the correction of an overlap has. About
// the centre of mass.
TEST(ContactImpact, KeepsAngularMomentumWithoutFriction) {
    Flight flight = twoSheets(0.0);
    double mass = 0;
    dvec3 centre(0.0);
    for (std::size_t i = 0; i < flight.x.size(); ++i) {
        mass += flight.mass(i);
        centre += flight.mass(i) * flight.x[i];
    }
    for (dvec3& x : flight.x) x -= centre / mass;
    const dvec3 drift = flight.momentum() / mass;
    for (dvec3& v : flight.v) v -= drift;
    const dvec3 before = flight.angularMomentum();
    double scale = 0;
    for (std::size_t i = 0; i < flight.v.size(); ++i)
        scale += flight.mass(i) * glm::length(glm::cross(flight.x[i], flight.v[i]));
    const double start = flight.kinetic();
    for (int i = 0; i < 60; ++i) flight.fly(5e-4);
    EXPECT_LT(flight.kinetic(), 0.9 * start);
    EXPECT_LT(glm::length(flight.angularMomentum() - before), 1e-3 * scale);
}

// Gauss-Seidel descends from no impulse, so that no number of sweeps adds any: 1e-12 is rounding.
TEST(ContactImpact, AddsNoKineticEnergyInAnyInstant) {
    for (const double friction : {0.0, 0.3, 2.0})
        for (const int sweeps : {1, 2, 10}) {
            Flight flight = twoSheets(friction);
            flight.options.solver.sweeps = sweeps;
            const double start = flight.kinetic();
            double before = start;
            for (int i = 0; i < 60; ++i) {
                flight.fly(5e-4);
                const double now = flight.kinetic();
                EXPECT_LE(now, before + 1e-12 * start)
                    << "instant " << i << ", " << sweeps << " sweeps, μ " << friction;
                before = now;
            }
            EXPECT_LT(before, start);
        }
}

// Whether any edge was in a triangle at any of many times on the straight ways of an instant.
bool meetOnTheWay(const test::Skin& skin, const std::vector<dvec3>& from, const std::vector<dvec3>& to, int times) {
    std::vector<dvec3> x(from.size());
    for (int k = 1; k <= times; ++k) {
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = from[i] + (static_cast<double>(k) / times) * (to[i] - from[i]);
        if (countPiercings(skin, x) > 0) return true;
    }
    return false;
}

// Two small triangles, the one held or free, the other at 100 m/s from any side, in any phase: how many have been
// in each other at any time.
int countThrough(double step, const ContactOptions& options, int phases) {
    Dice dice(7);
    int through = 0;
    for (int n = 0; n < phases; ++n) {
        Flight flight;
        flight.options = options;
        const auto corners = [&](const dvec3& middle) {
            const dvec3 a = 0.05 * dice.direction(), b = 0.05 * dice.direction();
            return std::array<dvec3, 3>{middle + a, middle + b, middle - a - b};
        };
        const dvec3 from = dice.direction();
        flight.addTriangle(corners(0.02 * dice.vector()), dvec3(0.0), n % 2 == 0 ? 0.0 : 0.02, 0.001);
        flight.addTriangle(corners((0.12 + 100 * step * dice.between(0.0, 1.0)) * from), -100.0 * from, 0.01, 0.001);
        const test::Skin skin = flight.skin();
        bool isThrough = false;
        for (int i = 0; i < 3 + static_cast<int>(0.003 / step) && !isThrough; ++i) {
            const std::vector<dvec3> before = flight.x;
            flight.fly(step);
            isThrough = meetOnTheWay(skin, before, flight.x, 2 + static_cast<int>(step / 2e-5));  // 2 mm
        }
        through += isThrough ? 1 : 0;
    }
    return through;
}

TEST(ContactImpact, LetsNothingThroughAtAHundredMetresASecond) {
    for (const double step : {1e-4, 5e-4, 1e-3, 4e-3})  // 1 to 40 cm an instant, for 2 mm kept
        EXPECT_EQ(countThrough(step, {}, 200), 0) << step;
}

// The reason for certificates: impulses alone go by where the sides were nearest at the start.
TEST(ContactImpact, LetsSomeThroughWithoutCertificates) {
    ContactOptions options;
    options.certifies = false;
    EXPECT_GT(countThrough(1e-3, options, 200), 0);
}

// Past each other in planes that are 2 D apart, in any direction and phase.
TEST(ContactImpact, LeavesAloneWhatMisses) {
    Dice dice(3);
    for (const double step : {1e-4, 5e-4, 1e-3}) {
        int touched = 0;
        for (int n = 0; n < 200; ++n) {
            constexpr double thickness = 0.008;
            Flight flight;
            const dvec3 up = dice.direction(), along = glm::normalize(glm::cross(up, dice.direction())),
                        aside = glm::cross(along, up);
            const auto corner = [&](double height) {
                return height * up + 0.05 * dice.number() * along + 0.05 * dice.number() * aside;
            };
            const std::array<dvec3, 3> low{corner(-thickness - 0.02), corner(-thickness), corner(-thickness - 0.01)};
            std::array<dvec3, 3> high{corner(thickness + 0.02), corner(thickness), corner(thickness + 0.01)};
            for (dvec3& p : high) p -= (0.2 + 100 * step * dice.between(0.0, 1.0)) * along;
            flight.addTriangle(low, dvec3(0.0), 0.01, thickness / 2);
            flight.addTriangle(high, 100.0 * along, 0.01, thickness / 2);
            const std::vector<dvec3> before = flight.v;
            for (int i = 0; i < 4 + static_cast<int>(0.004 / step); ++i) flight.fly(step);
            touched += flight.v != before ? 1 : 0;
        }
        EXPECT_EQ(touched, 0) << "of 200, " << step << " s";
    }
}

// A ball at 100 m/s past another, by that share of their thickness: nearer than 0.95 of it they meet.
TEST(ContactImpact, MeetsWhatPassesNearerThanItKeeps) {
    for (const double share : {0.3, 0.5, 0.9, 1.1}) {
        constexpr double thickness = 0.008;
        Flight flight;
        flight.addBall(dvec3(0.0), dvec3(0.0), 0.0, thickness / 2);
        flight.addBall({-0.05, share * thickness, 0.0}, {100.0, 0.0, 0.0}, 0.01, thickness / 2);
        flight.fly(1e-3);
        EXPECT_EQ(flight.v[1] != dvec3(100.0, 0.0, 0.0), share < 1) << share;
    }
}

// A ball that nothing moves comes at a triangle of which two corners are held: the third goes out of the way by its
// lever, 1 / 0.3 or 1 / 0.2, but not by one of 1 / 0.05, of 0.6 % of the squares of the shares.
TEST(ContactImpact, FlingsNothingAwayByALongLever) {
    for (const double share : {0.3, 0.2, 0.05}) {
        Flight flight;
        flight.addBall({0.0, 0.008, share}, {0.0, -2.0, 0.0}, 0.0, 0.004);
        flight.addTriangle({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0, 0, 1)}, dvec3(0.0), 1.0, 0.004);
        flight.inverseMass[1] = flight.inverseMass[2] = 0;
        flight.fly(1e-3);
        EXPECT_NEAR(flight.v[3].y, share > 0.1 ? -2.0 / share : 0.0, 1e-9) << share;
    }
}

// A ball of 2 m/s down and 3 m/s along: of those it loses μ 2 m/s, μ the product of all three factors.
TEST(ContactFriction, HasTheFactorsOfBoth) {
    for (const auto& [ofBall, ofTriangle] : {std::pair(1.0, 1.0), {0.5, 1.0}, {1.0, 0.5}, {0.5, 0.25}, {0.0, 2.0}}) {
        Flight flight;
        flight.options.friction = 0.4;
        flight.addBall({0.0, 0.008, 0.0}, {3.0, -2.0, 0.0}, 0.1, 0.004);
        flight.addTriangle({dvec3(-1, 0, -1), dvec3(1, 0, -1), dvec3(0, 0, 1)}, dvec3(0.0), 0.0, 0.004);
        flight.surfaces[0].friction = ofBall;
        flight.surfaces[1].friction = ofTriangle;
        flight.fly(1e-4);
        EXPECT_NEAR(flight.v[0].x, 3.0 - 0.4 * ofBall * ofTriangle * 2.0, 1e-9) << ofBall << ", " << ofTriangle;
    }
}

// A ball over 40 cells of a flat sheet, pressed to it by its weight: the edges that it passes are no obstacles.
TEST(ContactFriction, IsAllThatSlowsWhatSlidesOnAFlatSheet) {
    for (const double h : {1e-3, 2.5e-4}) {
        Flight flight;
        flight.options.friction = 0.0;
        flight.addSheet({-0.1, 0.0, -0.5}, {1.0, 0, 0}, {0, 0, 1.0}, 50, dvec3(0.0), 0.0, 0.004);
        flight.addBall({0.0031, 0.008, -0.0217}, {5.0, 0.0, 0.3}, 0.01, 0.004);
        const int instants = static_cast<int>(std::lround(0.16 / h));
        for (int i = 0; i < instants; ++i) {
            flight.v.back().y -= 9.81 * h;
            flight.fly(h);
            ASSERT_NEAR(flight.x.back().y, 0.008, 4e-4) << i << ", " << h << " s";
        }
        EXPECT_GT(flight.v.back().x, 0.99 * 5.0) << h << " s";
        EXPECT_LT(flight.v.back().x, 5.0 + 1e-9) << h << " s";
    }
}

// Without friction the certificate takes the approach alone and leaves the sliding; zones, its last resort, take both.
TEST(ContactImpact, LeavesWhatItCatchesOnTheWayItsSliding) {
    const auto left = [](bool slides) {
        Dice dice(7);
        double kinetic = 0;
        for (int n = 0; n < 200; ++n) {
            Flight flight;
            flight.options.friction = 0;
            flight.options.slides = slides;
            const auto corners = [&](const dvec3& middle) {
                const dvec3 a = 0.05 * dice.direction(), b = 0.05 * dice.direction();
                return std::array<dvec3, 3>{middle + a, middle + b, middle - a - b};
            };
            const dvec3 from = dice.direction();
            flight.addTriangle(corners(0.02 * dice.vector()), dvec3(0.0), 0.02, 0.001);
            flight.addTriangle(corners((0.12 + 0.1 * dice.between(0.0, 1.0)) * from), -100.0 * from, 0.01, 0.001);
            for (int i = 0; i < 6; ++i) flight.fly(1e-3);
            kinetic += flight.kinetic();
        }
        return kinetic;
    };
    EXPECT_GT(left(true), 1.3 * left(false));
}

// Of an overlap at the start a fifth is taken back an instant, and no speed is given.
// A ball presses a triangle, and then flies away.
TEST(ContactImpact, KeepsNoForceOfAContactThatIsOver) {
    Flight flight;
    flight.addBall({0.0, 0.0085, 0.0}, {0.0, -1.0, 0.0}, 0.1, 0.004);
    flight.addTriangle({dvec3(-0.1, 0, -0.1), dvec3(0.1, 0, -0.1), dvec3(0, 0, 0.2)}, dvec3(0.0), 0.0, 0.004);
    flight.fly(1e-3);
    EXPECT_EQ(flight.group->keptForces().size(), 1U);
    flight.v[0] = {0.0, 10.0, 0.0};
    flight.fly(1e-2);
    flight.fly(1e-2);
    EXPECT_TRUE(flight.group->keptForces().empty());
}

// Of 5 mm, the 1.6 mm that the pair may overlap stay: a fifth of its thickness.
TEST(ContactImpact, TakesOverlapBackByATenthABlockWithoutSpeed) {
    const auto gapsAre = [](double recovery) {
        Flight flight;
        flight.options.solver.recovery = recovery;
        flight.addBall({0.0, 0.003, 0.0}, dvec3(0.0), 0.1, 0.004);
        flight.addTriangle({dvec3(-0.1, 0, -0.1), dvec3(0.1, 0, -0.1), dvec3(0, 0, 0.2)}, dvec3(0.0), 0.2, 0.004);
        const double mass = 0.1 + 3 * 0.2;
        const auto centre = [&] {
            dvec3 sum(0.0);
            for (std::size_t i = 0; i < 4; ++i) sum += flight.mass(i) * flight.x[i];
            return sum / mass;
        };
        const dvec3 before = centre();
        constexpr double allowed = 0.2 * 0.008;
        double gap = 0.003 - 0.008 + allowed, most = 0;
        for (int i = 0; i < 10; ++i) {
            flight.fly(1e-2);
            gap *= 0.9;
            const double under = (flight.x[1].y + flight.x[2].y + 2 * flight.x[3].y) / 4;
            most = std::max(most, std::abs(flight.x[0].y - under - 0.008 + allowed - gap));
            for (const dvec3& v : flight.v) EXPECT_EQ(v, dvec3(0.0));
        }
        EXPECT_LT(glm::length(centre() - before), 1e-15);
        return most;
    };
    EXPECT_LT(gapsAre(SolverOptions{}.recovery), 1e-9);
    EXPECT_GT(gapsAre(5 * SolverOptions{}.recovery), 1e-3);
}

// A tenth of 5 mm in 0.1 ms would be 5 m/s.
TEST(ContactImpact, TakesOverlapBackNoFasterThanAMetreASecond) {
    constexpr double h = 1e-4;
    Flight flight;
    flight.addBall({0.0, 0.003, 0.0}, dvec3(0.0), 0.1, 0.004);
    flight.addTriangle({dvec3(-1, 0, -1), dvec3(1, 0, -1), dvec3(0, 0, 2)}, dvec3(0.0), 0.0, 0.004);
    for (int i = 1; i <= 5; ++i) {
        flight.fly(h);
        EXPECT_NEAR(flight.x[0].y, 0.003 + i * 1.0 * h, 1e-12) << i;
    }
}

// A point and a place that nothing moves, in contact.
ContactConstraint restingPair(int point, std::array<int, 3> corners) {
    ContactConstraint pair{};
    pair.points = {point, corners[0], corners[1], corners[2]};
    pair.weights = {1.0, -0.25, -0.25, -0.5};
    pair.normal = {0.0, 1.0, 0.0};
    pair.distance = pair.thickness = 0.01;
    pair.isPoint = pair.isActive = true;
    return pair;
}

// Of two points of one mass, 3 mm nearer each other than they may be, the lower is on the ground: the upper alone goes.
// The correction of 0.3 mm is made for both; softer than the ground by twice their inverse mass, it gives way to
// 0.3 (1 + 1) / (1 + 2) mm.
TEST(ContactImpact, TakesOverlapBackNotIntoWhatHoldsIt) {
    ContactConstraint pair = restingPair(0, {1, 2, 3});
    pair.weights = {1.0, -1.0, 0.0, 0.0};
    pair.distance = pair.thickness - 0.005;
    const KinematicContact held{.points = {1, -1, -1}, .normal = {0.0, 1.0, 0.0}};
    const std::vector<double> inverseMass{1.0, 1.0, 0.0, 0.0};
    std::vector<dvec3> u(4, dvec3(0.0)), v = u, shift = u;
    SolverOptions options;
    options.sweeps = 100;
    options.settled = 1e-6;
    ContactSolver pressing;
    solveOnce(pressing, {std::span(&pair, 1), std::span(&held, 1), inverseMass, {}, 1.0, 1, options}, u, v, shift);
    EXPECT_NEAR(shift[0].y, 0.2e-3, 2e-8);  // where sweeps end
    EXPECT_NEAR(shift[1].y, 0.0, 2e-8);
    EXPECT_EQ(u[0], dvec3(0.0));
}

// A step of leap-frog from places x keeps the energy of springs, and of the velocities at x. So a pair gives back its
// share of the 2 m/s by which it closes at the start of the step. The kick of 0.1 m/s after that stays, wherever in the
// step the pair meets.
TEST(ContactImpact, GivesBackWhatItClosesByAsItsStepBegins) {
    for (const double share : {0.0, 0.25, 0.75}) {
        ContactConstraint pair = restingPair(0, {1, 2, 3});
        pair.restitution = 0.5;
        constexpr double h = 1e-3, closing = 2.0, kick = 0.1;
        pair.distance = pair.thickness + share * closing * h;
        const std::vector<double> inverseMass{1.0, 0.0, 0.0, 0.0};
        std::vector<dvec3> start(4, dvec3(0.0)), u = start, v = start;
        start[0] = {0.0, -closing, 0.0};
        u[0] = v[0] = {0.0, -closing - kick, 0.0};
        const std::vector<dvec3> x(4, dvec3(0.0));
        ContactSolver pressing;
        pressing.begin({std::span(&pair, 1), {}, inverseMass, x, h});
        pressing.step(x, start, u, v);
        EXPECT_NEAR(u[0].y, 0.5 * closing - kick, 1e-12) << share;
        EXPECT_EQ(v[0], u[0]) << share;
    }
}

// Two points on one triangle are one cluster, unless nothing moves it.
TEST(ContactImpact, PassesNothingOnThroughWhatIsHeld) {
    const std::vector<ContactConstraint> pairs{restingPair(0, {2, 3, 4}), restingPair(1, {2, 3, 4})};
    for (const bool isHeld : {true, false}) {
        const double inverse = isHeld ? 0.0 : 1.0;
        const std::vector<double> inverseMass{1.0, 1.0, inverse, inverse, inverse};
        std::vector<dvec3> u(5, dvec3(0.0)), v = u, shift = u;
        u[0] = v[0] = {0.0, -1.0, 0.0};
        ContactSolver pressing;
        solveOnce(pressing, {pairs, {}, inverseMass, {}, 1e-3}, u, v, shift);
        EXPECT_EQ(pressing.clusters(), isHeld ? 2 : 1);
    }
}

// A collider stops points that are slower than itself, and releases faster ones.
TEST(ContactImpact, ACollidersSupportDoesNotPull) {
    for (const double speed : {-1.0, 0.2, 0.7, 3.0}) {
        Row support;
        support.normal = {{0, 1, 0, 0}};
        support.mass = 2.0;
        support.weights[0] = 1;
        support.gains[0] = support.largestGain = 0.5;
        support.closing = -0.5;
        support.slots[1] = support.slots[2] = support.slots[3] = 1;
        std::array<Four, 2> u{{{{0, speed, 0, 0}}, {}}};
        projectedGaussSeidel(std::span(&support, 1), 10, 1e-9, u);
        EXPECT_EQ(u[0].of[1], std::max(speed, 0.5));
        EXPECT_NEAR(support.impulse.of[3], 2.0 * std::max(0.0, 0.5 - speed), 1e-15);
    }
}

// A pile of n equal points comes down on a held point, until no velocity changes by a thousandth. Of the slowest mode a
// sweep alone leaves cos² (π / (2n + 1)), so that sweeps alone are in proportion to n²: 2538 of 40 points. With the
// steps on between them, as in conjugate gradients, they are in proportion to n.
TEST(ContactImpact, TakesSweepsInProportionToThePile) {
    for (const int n : {10, 20, 40}) {
        std::vector<Row> rows;
        for (int k = 0; k < n; ++k) {
            Row& row = rows.emplace_back();
            row.normal = {{0, 1, 0, 0}};
            row.slots[0] = k + 1;
            row.slots[1] = k;
            row.weights[0] = row.gains[0] = row.largestGain = 1;
            row.weights[1] = -1;
            row.gains[1] = k > 0 ? -1 : 0;
            row.mass = k > 0 ? 0.5 : 1.0;
        }
        std::vector<Four> u(static_cast<std::size_t>(n) + 1, Four{{0, -1, 0, 0}});
        u[0] = {};
        EXPECT_LT(projectedGaussSeidel(rows, 5 * n, 1e-3, u), 4 * n);      // it is 3.5 to 3.7 n
        for (const Four& v : u) EXPECT_NEAR(v.of[1], 0.0, 1e-3 * n) << n;  // which leaves 4e-4 to 7e-4 n
        // Half of the right impulses, which are those of all the weight above, is a start that is scaled to the whole.
        std::vector<Four> fresh(static_cast<std::size_t>(n) + 1, Four{{0, -1, 0, 0}});
        fresh[0] = {};
        for (int k = 0; k < n; ++k) rows[k].impulse = {{0, 0, 0, 0.5 * (n - k)}};
        EXPECT_EQ(projectedGaussSeidel(rows, 5 * n, 1e-12, fresh), 1);
    }
}

// An impulse along the way between the nearest places has no moment. Of weights in another order it would have one.
TEST(ContactImpact, TurnsNothingAsAWhole) {
    const auto moment = [](bool areSwapped) {
        const std::array<dvec3, 3> corners{dvec3(0.0), dvec3(0.0, 0.0, 0.2), dvec3(0.2, 0.0, 0.0)};
        ContactConstraint pair{};
        pair.points = {0, 1, 2, 3};
        pair.weights = {1.0, -0.6, -0.3, -0.1};
        pair.normal = {0.0, 1.0, 0.0};
        pair.distance = pair.thickness = 0.008;
        pair.isPoint = pair.isActive = true;
        std::vector<dvec3> x{pair.distance * pair.normal};
        for (std::size_t k = 0; k < 3; ++k) {
            x[0] -= pair.weights[k + 1] * corners[k];
            x.push_back(corners[k]);
        }
        if (areSwapped) std::swap(pair.weights[1], pair.weights[2]);
        const std::vector<double> inverseMass{5.0, 2.0, 3.0, 4.0};
        std::vector<dvec3> u(4, dvec3(0.0)), v(4, dvec3(0.0)), shift(4, dvec3(0.0));
        u[0] = v[0] = {0.0, -2.0, 0.0};
        const std::vector<dvec3> before = u;
        ContactSolver pressing;
        solveOnce(pressing, {std::span(&pair, 1), {}, inverseMass, {}, 1e-3}, u, v, shift);
        EXPECT_GT(pressing.impulses()[0], 0.1);
        dvec3 sum(0.0);
        for (std::size_t i = 0; i < 4; ++i) sum += glm::cross(x[i], u[i] - before[i]) / inverseMass[i];
        return glm::length(sum) / pressing.impulses()[0];  // [m]
    };
    EXPECT_LT(moment(false), 1e-16);
    EXPECT_GT(moment(true), 0.05);
}

// A point on the ground with μ that another presses down by λ while it slides: the ground's impulse by that is μ λ,
// or all its sliding momentum.
TEST(ContactFriction, OfTheGroundBearsWhatIsOnTop) {
    for (const double slide : {0.1, 3.0}) {  // [m/s]
        ContactConstraint pair{};
        pair.points = {0, 1, 2, 3};
        pair.weights = {1.0, -1.0, 0.0, 0.0};
        pair.normal = {0.0, 1.0, 0.0};
        pair.distance = pair.thickness = 0.01;
        pair.isPoint = pair.isActive = true;
        KinematicContact held{.points = {1, -1, -1}, .normal = {0.0, 1.0, 0.0}};
        held.friction = 0.4;
        const std::vector<double> inverseMass{1.0, 2.0, 0.0, 0.0};
        std::vector<dvec3> u{{0.0, -1.0, 0.0}, {slide, 0.0, 0.0}, dvec3(0.0), dvec3(0.0)}, v = u, shift(4, dvec3(0.0));
        SolverOptions options;
        options.sweeps = 100;
        ContactSolver pressing;
        solveOnce(pressing, {std::span(&pair, 1), std::span(&held, 1), inverseMass, {}, 1.0, 1, options}, u, v, shift);
        const double ought = std::max(0.0, slide - 0.4 * 1.0 * 2.0);  // λ = 1 kg · 1 m/s, on half a kilogram
        for (const auto& of : {u, v}) {
            EXPECT_LT(glm::distance(of[0], dvec3(0.0)), 2e-5);  // where sweeps end
            EXPECT_LT(glm::distance(of[1], dvec3(ought, 0.0, 0.0)), 2e-5);
        }
    }
}

// A point on a held plane under g, μ = 0.4: it slides where the slope is steeper than that, tan 21.8° = 0.4, by
// g (sin α - μ cos α) t; else it stays. Ten sweeps of one pair are exact.
TEST(ContactFriction, HoldsUpToItsAngleAndSlowsBeyondIt) {
    const auto slides = [](double degrees, double friction) {
        const double angle = degrees * pi / 180;
        const dvec3 down(std::cos(angle), -std::sin(angle), 0.0), up(std::sin(angle), std::cos(angle), 0.0);
        Flight flight;
        flight.options.friction = friction;
        flight.addBall(0.008 * up, dvec3(0.0), 0.1, 0.004);
        const dvec3 aside(0, 0, 1);
        flight.addTriangle({-2.0 * down - 2.0 * aside, 4.0 * down, -2.0 * down + 2.0 * aside}, dvec3(0.0), 0.0, 0.004);
        const double h = 1e-3;
        for (int i = 0; i < 500; ++i) {
            flight.v[0].y -= 9.81 * h;
            flight.fly(h);
        }
        return glm::dot(flight.x[0], down);
    };
    const auto theory = [](double degrees, double friction) {
        const double angle = degrees * pi / 180;
        return 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle)) * 0.25;
    };
    EXPECT_LT(std::abs(slides(21.0, 0.4)), 1e-6);
    for (const double degrees : {22.5, 30.0})
        EXPECT_NEAR(slides(degrees, 0.4) / theory(degrees, 0.4), 1.0, 0.01) << degrees;  // half a step of 500: 0.2 %
    // Twice the friction differs.
    EXPECT_LT(std::abs(slides(30.0, 0.8)), 1e-6);
}

// A point pressed through a triangle that it was hardly away from: both come apart, with the momentum they had, as far
// as rounding has no say, 0.02 of the 10 mm they keep, and no further. A point that a collider holds from below stays.
TEST(ContactGuard, SlidesAPinchClearOfRoundingAndNotIntoWhatHoldsIt) {
    const ContactConstraint pair{{0, 1, 2, 3}, {1.0, -0.25, -0.25, -0.5}, {0, 1, 0}, 1e-9, 0.01, 0.0, 0, 0, true, true};
    const std::vector<double> inverseMass(4, 1.0);
    for (const bool isHeld : {false, true}) {
        std::vector<dvec3> x{{0, -1e-6, 0}, {-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}, v{{0, -1, 0}, {}, {}, {}};
        const std::vector<dvec3> before = x;
        std::vector<KinematicContact> held;
        for (const int i : {1, 2, 3})
            if (isHeld) held.push_back({.points = {i, -1, -1}, .normal = {0, 1, 0}});
        std::vector<int> moved;
        EXPECT_TRUE(slideApart(pair, inverseMass, held, x, v, moved));
        const auto other = static_cast<std::size_t>(isHeld ? 1 : moved.back());
        EXPECT_NEAR(x[0].y - x[other].y, 2e-4, 1e-15);
        EXPECT_NEAR(v[0].y - v[other].y, 0.0, 1e-15);  // it took the approach of 1 m/s, and no more
        EXPECT_EQ(moved.size(), isHeld ? 1U : 2U);
        for (std::size_t i = 1; i < 4; ++i)
            if (isHeld) EXPECT_EQ(x[i], before[i]);
        if (!isHeld) EXPECT_NEAR(v[0].y + v[other].y, -1.0, 1e-15);
    }
}

}  // namespace
}  // namespace taut::contact
