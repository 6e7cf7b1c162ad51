// Nearest places, certificates and piercings, against sampling.
#include <set>

#include "contact_support.h"
#include "taut/contact/broad_phase.h"
#include "taut/contact/certificate.h"
#include "taut/contact/closest_points.h"
#include "taut/contact/rigid_side.h"
#include "taut/core/private/instruction_set.h"

namespace taut::contact {
namespace {

// Of corners now and then in a line, or at one place.
std::array<dvec3, 4> fourPoints(Dice& dice, int n) {
    std::array<dvec3, 4> p{dice.vector(), dice.vector(), dice.vector(), dice.vector()};
    if (n % 10 == 1) p[3] = 0.5 * (p[1] + p[2]);
    if (n % 10 == 2) p[2] = p[1];
    if (n % 10 == 3) p[3] = p[2] + (p[1] - p[0]);  // two segments side by side
    if (n % 10 == 4) p[1] = p[0];
    if (n % 10 == 5) p[3] = p[2] = p[1];
    return p;
}

TEST(ContactNearest, OnATriangleNoSampleIsNearer) {
    Dice dice(1);
    constexpr int grid = 40;
    for (int n = 0; n < 500; ++n) {
        const auto p = fourPoints(dice, n);
        const Closest on = closestPoints(p, true);
        const std::array<double, 3> w{-on.weights[1], -on.weights[2], -on.weights[3]};
        for (double weight : w) EXPECT_GE(weight, -1e-15) << n;
        EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-14);
        const double found = glm::distance(p[0], w[0] * p[1] + w[1] * p[2] + w[2] * p[3]);
        double least = 1e300;
        for (int i = 0; i <= grid; ++i)
            for (int j = 0; i + j <= grid; ++j) {
                const double a = static_cast<double>(i) / grid, b = static_cast<double>(j) / grid;
                least = std::min(least, glm::distance(p[0], a * p[1] + b * p[2] + (1 - a - b) * p[3]));
            }
        EXPECT_LE(found, least + 1e-12) << n;
        // Its feature is the one that the weights name.
        const int zeros = (w[0] == 0 ? 1 : 0) + (w[1] == 0 ? 1 : 0) + (w[2] == 0 ? 1 : 0);
        const auto feature = static_cast<Feature>(on.where);
        const int kind = feature == Feature::face ? 0 : (feature < Feature::corner0 ? 1 : 2);
        EXPECT_GE(zeros, kind) << n;
    }
}

// One less than a batch, so that vectors have remainders.
TEST(ContactNearest, KernelsGiveTheBitsOfOnePairOnEveryInstructionSet) {
    const core::InstructionSet before = core::instructionSet();
    for (const core::InstructionSet set :
         {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512}) {
        if (!core::isSupported(set)) continue;
        core::useInstructionSet(set);
        for (const bool isPoint : {true, false}) {
            Dice dice(3);
            ClosestLanes lanes{};
            std::vector<std::array<dvec3, 4>> places;
            for (int n = 0; n < closestBatch - 1; ++n) {
                places.push_back(fourPoints(dice, n));
                for (int k = 0; k < 4; ++k)
                    for (int axis = 0; axis < 3; ++axis) lanes.at[k][axis][n] = places.back()[k][axis];
            }
            (isPoint ? closestKernels().onTriangles : closestKernels().onSegments)(lanes, closestBatch - 1);
            for (int n = 0; n < closestBatch - 1; ++n) {
                const Closest on = closestPoints(places[n], isPoint);
                for (int k = 0; k < 4; ++k) EXPECT_EQ(lanes.weights[k][n], on.weights[k]) << n;
                for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(lanes.separation[axis][n], on.separation[axis]) << n;
                EXPECT_EQ(lanes.where[n], on.where) << n;
            }
        }
    }
    core::useInstructionSet(before);
}

TEST(ContactNearest, OnSegmentsNoSampleIsNearer) {
    Dice dice(2);
    constexpr int grid = 60;
    for (int n = 0; n < 500; ++n) {
        const auto p = fourPoints(dice, n);
        const Closest on = closestPoints(p, false);
        const double ownS = on.weights[1], ownT = -on.weights[3];
        for (const double share : {ownS, ownT}) EXPECT_TRUE(share >= 0 && share <= 1) << share;
        const auto distance = [&](double s, double t) {
            return glm::distance(p[0] + s * (p[1] - p[0]), p[2] + t * (p[3] - p[2]));
        };
        double least = 1e300;
        for (int i = 0; i <= grid; ++i)
            for (int j = 0; j <= grid; ++j)
                least = std::min(least, distance(static_cast<double>(i) / grid, static_cast<double>(j) / grid));
        EXPECT_LE(distance(ownS, ownT), least + 1e-12) << n;
    }
}

// Of the sides of a pair at places p, as the group finds them.
ContactConstraint pairAt(const std::array<dvec3, 4>& p, bool isPoint) {
    ContactConstraint pair{};
    pair.points = {0, 1, 2, 3};
    pair.isPoint = isPoint;
    const Closest on = closestPoints(p, isPoint);
    pair.weights = on.weights;
    const dvec3 apart = on.separation;
    pair.distance = glm::length(apart);
    pair.normal = apart / pair.distance;
    return pair;
}

// Least distance of the sides at any of many times; and whether the four became one plane inside both at any.
bool passThroughEachOther(const std::array<dvec3, 4>& from, const std::array<dvec3, 4>& to, bool isPoint) {
    const auto at = [&](double t) {
        std::array<dvec3, 4> x;
        for (std::size_t k = 0; k < 4; ++k) x[k] = from[k] + t * (to[k] - from[k]);
        return x;
    };
    const auto volume = [&](double t) {
        const auto x = at(t);
        return test::sixVolumes(x[0], x[1], x[2], x[3]);
    };
    constexpr int times = 400;
    for (int k = 0; k < times; ++k) {
        double low = static_cast<double>(k) / times, high = static_cast<double>(k + 1) / times;
        const bool isAbove = volume(low) > 0;
        if (isAbove == (volume(high) > 0)) continue;
        for (int i = 0; i < 50; ++i) (((volume(0.5 * (low + high)) > 0) == isAbove) ? low : high) = 0.5 * (low + high);
        if (pairAt(at(low), isPoint).distance < 1e-9) return true;
    }
    return false;
}

// Ways of about the distance, as common motion, turns and approaches; half of the passages are real.
TEST(ContactCertificate, IsNeverGivenToWhatPassesThroughEachOther) {
    Dice dice(5);
    int passages = 0, certified = 0, clear = 0;
    for (int n = 0; n < 6000; ++n) {
        const bool isPoint = n % 2 == 0;
        const std::array<dvec3, 4> from{dice.vector(), dice.vector(), dice.vector(), dice.vector()};
        std::array<dvec3, 4> to = from;
        const dvec3 common = 5.0 * dice.vector(), first = dice.vector();
        for (std::size_t k = 0; k < 4; ++k) {
            to[k] += common + 0.3 * dice.vector();
            if (k < (isPoint ? 1U : 2U)) to[k] += first;
        }
        const ContactConstraint pair = pairAt(from, isPoint);
        const std::vector<dvec3> x0(from.begin(), from.end()), x1(to.begin(), to.end());
        const bool isCertain = isCertified(pair, x0, x1), passes = passThroughEachOther(from, to, isPoint);
        EXPECT_FALSE(isCertain && passes) << n;
        passages += passes ? 1 : 0;
        certified += isCertain ? 1 : 0;
        clear += passes ? 0 : 1;
    }
    EXPECT_GT(passages, 300);
    // It is of use only if it is given to nearly all others.
    EXPECT_GT(certified, 0.85 * clear);
}

// A pair that does not approach is certified at any speed.
TEST(ContactCertificate, IsGivenToWhatMovesAlike) {
    Dice dice(6);
    for (int n = 0; n < 200; ++n) {
        const std::array<dvec3, 4> from{dice.vector(), dice.vector(), dice.vector(), dice.vector()};
        const ContactConstraint pair = pairAt(from, n % 2 == 0);
        const dvec3 way = 1e3 * dice.vector();
        std::vector<dvec3> x0(from.begin(), from.end()), x1;
        for (const dvec3& x : x0) x1.push_back(x + way);
        EXPECT_TRUE(isCertified(pair, x0, x1)) << n;
    }
}

// Two formulations of the same question; edges of triangles that cross in general, or only nearly.
TEST(ContactPiercing, IsWhatTheSignsOfVolumesSay) {
    Dice dice(8);
    int through = 0;
    for (int n = 0; n < 4000; ++n) {
        const std::array<dvec3, 3> t{dice.vector(), dice.vector(), dice.vector()};
        const dvec3 p = dice.vector(), q = dice.vector();
        Piercing found;
        const bool isThrough = pierces(p, q, t[0], t[1], t[2], found);
        EXPECT_EQ(isThrough, test::goesThrough(p, q, t)) << n;
        if (!isThrough) continue;
        ++through;
        const dvec3 on = found.weights[0] * t[0] + found.weights[1] * t[1] + found.weights[2] * t[2];
        EXPECT_LT(glm::distance(on, p + found.s * (q - p)), 1e-12);
    }
    EXPECT_GT(through, 300);
}

// A rope of segments of L = 10 mm that is 2 × 10 mm thick: neighbours but one are L apart at rest and keep 0.7 L, those
// after them 2 L and keep 1.4 L, all others the thickness.
TEST(ContactDistance, IsTheThicknessOrAShareOfTheDistanceAtRest) {
    constexpr double L = 0.01, thickness = 0.01;
    constexpr int segments = 6;
    ContactSurface surface;
    surface.thickness = thickness;
    std::vector<dvec3> rest;
    for (int i = 0; i <= segments; ++i) {
        rest.push_back({i * L, 0.0, 0.0});
        surface.points.push_back(i);
        if (i > 0) surface.lines.push_back({i - 1, i});
    }
    const Elements elements({surface}, rest);
    for (int e = 1; e < segments; ++e) {
        const Edge &first = elements.edges()[0], &second = elements.edges()[e];
        EXPECT_NEAR(elements.thicknessOf({first.a, first.b, second.a, second.b}, false),
                    std::min(2 * thickness, 0.7 * (e - 1) * L), 1e-15);
    }
}

// All elements of two crumpled sheets that go where they like, against all others at 33 times of their straight ways.
TEST(ContactBroadPhase, LeavesOutNoPairThatComesWithinReachOnItsWay) {
    Dice dice(11);
    Flight flight;
    for (int k = 0; k < 2; ++k)
        flight.addSheet({0.01 * k, 0.03 * k, 0.0}, {0.3, 0, 0}, {0, 0, 0.3}, 8, dvec3(0.0), 1e-3, 0.004).meetsItself =
            true;
    std::vector<dvec3> x0, x1;
    for (const dvec3& x : flight.x) {
        x0.push_back(x + 0.02 * dice.vector());
        x1.push_back(x0.back() + dvec3(0.1, -0.2, 0.0) + 0.03 * dice.vector());
    }
    const Elements elements(flight.surfaces, flight.x);
    BroadPhase near(elements);
    near.find(x0, x1);
    std::set<std::array<int, 3>> found;  // 1: edges
    BoxQuery query;
    std::vector<CandidatePair> candidates;
    for (const LeafPair pair : near.near()) {
        candidates.clear();
        near.addPoints(pair, query, candidates);
        for (const CandidatePair& own : candidates) found.insert({0, own.a, own.b});
        candidates.clear();
        near.addEdges(pair, query, candidates);
        for (const CandidatePair& own : candidates) found.insert({1, own.a, own.b});
    }
    const double reach = nearShare * 2 * 0.004;
    int inReach = 0;
    const auto look = [&](const std::array<int, 4>& points, bool isPoint, int a, int b) {
        for (int n = 0; n <= 32; ++n) {
            Corners now;
            for (int k = 0; k < 4; ++k) now[k] = x0[points[k]] + n / 32.0 * (x1[points[k]] - x0[points[k]]);
            if (length(closestPoints(now, isPoint).separation) > reach) continue;
            ++inReach;
            EXPECT_TRUE(found.contains({isPoint ? 0 : 1, a, b})) << a << ", " << b;
            return;
        }
    };
    for (std::size_t t = 0; t < elements.triangles().size(); ++t)
        for (int i = 0; i < elements.pointCount(); ++i) {
            const Triangle& triangle = elements.triangles()[t];
            const std::array<int, 3>& c = triangle.points;
            if (!elements.areNeighbours(i, triangle)) look({i, c[0], c[1], c[2]}, true, i, static_cast<int>(t));
        }
    for (std::size_t f = 0; f < elements.edges().size(); ++f)
        for (std::size_t e = 0; e < f; ++e) {
            const Edge &first = elements.edges()[e], &second = elements.edges()[f];
            if (!elements.areNeighbours(first, second))
                look({first.a, first.b, second.a, second.b}, false, static_cast<int>(e), static_cast<int>(f));
        }
    EXPECT_GT(inReach, 500);
    EXPECT_LT(found.size(), elements.triangles().size() * static_cast<std::size_t>(elements.pointCount()) / 4);
}

// A wall that stood still comes to a ball that it was far from.
TEST(ContactBroadPhase, FindsWhatBeginsToMove) {
    Flight flight;
    flight.addBall({0.0, 0.0, 0.0}, dvec3(0.0), 1.0, 0.005);
    flight.addTriangle({dvec3(-1, -1, 1), dvec3(1, -1, 1), dvec3(0, 1, 1)}, dvec3(0.0), 0.0, 0.005);
    Elements elements(flight.surfaces, flight.x);
    BroadPhase near(elements);
    std::vector<dvec3> x = flight.x;
    for (const bool isStill : {true, false, true}) {
        elements.setStill(1, isStill);
        std::vector<dvec3> after = x;
        if (!isStill)
            for (std::size_t i = 1; i < 4; ++i) after[i].z = 0.0;
        near.find(x, after);
        x = after;
        BoxQuery query;
        std::vector<CandidatePair> candidates;
        for (const LeafPair pair : near.near()) near.addPoints(pair, query, candidates);
        EXPECT_EQ(candidates.empty(), x[1].z == 1.0);
    }
}

// So nothing of it is in contact as it was built, however thick it is.
TEST(ContactDistance, LeavesAThickSheetAsItWasBuilt) {
    Flight flight;
    ContactSurface& sheet = flight.addSheet(dvec3(0.0), {0.1, 0, 0}, {0, 0, 0.1}, 8, {0.0, -3.0, 1.0}, 1e-3, 0.03);
    sheet.meetsItself = true;
    const std::vector<dvec3> before = flight.v;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(flight.fly(1e-3).impulses, 0);
    EXPECT_EQ(flight.v, before);
}

// Two faces in a V of which the edge is the bottom, the one rising by an angle of that sine towards the body above: up
// to half of `valley` the edge counts as one that stands out, at `valley` it pushes nothing back, beyond it does not
// push.
TEST(ContactGeometry, AnEdgeCountsTheLessTheMoreFacesRiseBesideIt) {
    const std::array<std::pair<double, double>, 6> cases{
        {{-0.3, 1.0}, {0.0, 1.0}, {0.1, 1.0}, {0.15, 0.5}, {0.2, 0.0}, {0.25, -0.5}}};
    for (const auto& [sine, ought] : cases) {
        const double cosine = std::sqrt(1 - sine * sine);
        const std::vector<dvec3> x{{-0.1, 0, 0}, {0.1, 0, 0}, {0, 0.03 * sine, 0.03 * cosine}, {0, 0, -0.05}};
        ContactSurface surface;
        surface.points = {0, 1, 2, 3};
        surface.triangles = {{0, 1, 2}, {1, 0, 3}};
        const Elements elements({surface}, x);
        int tried = 0;
        for (const Edge& edge : elements.edges()) {
            if (edge.triangles[1] < 0) continue;
            EXPECT_NEAR(convexityOf(elements, edge, dvec3(0.0), {0, 1, 0}, x), ought, 1e-12) << sine;
            ++tried;
        }
        EXPECT_EQ(tried, 1);
    }
}

}  // namespace
}  // namespace taut::contact
