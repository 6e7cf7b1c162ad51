// Ropes, knots, islands of several methods and steps, cuts, restarts: bodies that touch, with other features of a
// world.
#include "support/knots.h"
#include "taut/core/private/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/world/private/body_surfaces.h"
#include "touching_scenes.h"

namespace taut::test::touching {
namespace {

using world::World;

world::RopeSpec rope(const std::string& name, const dvec3& start, const dvec3& end, int segments) {
    world::RopeSpec spec;
    spec.name = name;
    spec.start = start;
    spec.end = end;
    spec.segments = segments;
    spec.mass = 0.1;
    spec.stretch = 200.0;
    spec.dampingTime = 1e-3;
    spec.drag = 0.5;
    spec.thickness = keep / 2;
    spec.touch = world::Touch::all;
    return spec;
}

double lowest(const std::vector<dvec3>& x) {
    double low = 1e300;
    for (const dvec3& p : x) low = std::min(low, p.y);
    return low;
}
double highest(const std::vector<dvec3>& x) {
    double high = -1e300;
    for (const dvec3& p : x) high = std::max(high, p.y);
    return high;
}

TEST(TouchingRope, LiesOnAClothAndBearsOne) {
    for (const bool isRopeAbove : {true, false}) {
        world::SceneSpec spec = scene();
        world::RopeSpec line =
            rope("line", {-0.35, isRopeAbove ? 0.1 : 0.0, 0.03}, {0.35, isRopeAbove ? 0.1 : 0.0, -0.01}, 24);
        world::ClothSpec cloth = sheet("cloth", {-0.2, isRopeAbove ? 0.0 : 0.1, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 8);
        if (isRopeAbove)
            cloth.hold = {"left", "right"};
        else
            line.hold = {"start", "end"};
        spec.bodies.add(cloth);
        spec.bodies.add(line);
        World world(spec);
        const PiercingWitness witness(spec, {"cloth.cloth", "rope.line"});
        for (int i = 0; i < 72; ++i) {
            ASSERT_FALSE(world.advance());
            ASSERT_EQ(witness.count(world), 0) << isRopeAbove << ", tick " << i;
        }
        // A fall of 1.2 s would end 7 m below.
        EXPECT_GT(lowest(positionsOf(world, "rope.line")), -0.5) << isRopeAbove;
        EXPECT_GT(lowest(positionsOf(world, "cloth.cloth")), -0.5) << isRopeAbove;
    }
}

// An overhand knot, loose, whose ends two hands pull apart until it is tight.
world::SceneSpec knotScene(double pull) {
    world::SceneSpec spec = scene(0.1);
    spec.world.gravity = dvec3(0.0);
    world::NetSpec net;
    net.name = "knot";
    net.drag = 2.0;
    net.dampingTime = 1e-3;
    net.thickness = keep / 2;
    net.touch = world::Touch::all;
    // Part of a trefoil, (sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t), opened and led out sideways.
    std::vector<dvec3> path;
    constexpr double pi = 3.14159265358979323846, size = 0.03;
    constexpr int turns = 44;
    const auto curve = [](double t) {
        return size *
               dvec3(std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -1.6 * std::sin(3 * t));
    };
    const double from = 0.5 * pi, gap = 0.3;
    const dvec3 first = curve(from + gap), last = curve(from + 2 * pi - gap);
    for (int i = 6; i > 0; --i) path.push_back(first + dvec3(0.03 * i, 0.006 * i, 0.0));
    for (int i = 0; i <= turns; ++i) path.push_back(curve(from + gap + (2 * pi - 2 * gap) * i / turns));
    for (int i = 1; i <= 6; ++i) path.push_back(last + dvec3(0.03 * i, -0.006 * i, 0.0));
    for (std::size_t i = 0; i < path.size(); ++i) {
        net.points.push_back({"p" + std::to_string(i), path[i], 0.002, false, {}});
        if (i > 0) net.springs.push_back({"p" + std::to_string(i - 1), "p" + std::to_string(i), 400.0, {}, {}, {}});
    }
    spec.bodies.add(net);
    int end = 0;
    for (const char* id : {"left", "right"}) {
        world::GrabAction grab;
        grab.target = "net.knot@p" + std::to_string(end == 0 ? 0 : path.size() - 1);
        grab.id = id;
        grab.rigid = true;
        spec.actions.add(grab);
        world::MoveAction move;
        move.id = id;
        const dvec3 place = end == 0 ? path.front() : path.back();
        move.to = place + pull * dvec3(0.0, end == 0 ? 1.0 : -1.0, 0.0);
        move.over = 1.5;
        move.ease = world::Ease::smooth;
        spec.actions.add(move);
        ++end;
    }
    return spec;
}

TEST(TouchingRope, OverhandKnotStaysOneWhenItIsPulledTight) {
    for (const bool touches : {true, false}) {
        world::SceneSpec spec = knotScene(0.30);
        if (!touches) spec.bodies.of<world::NetSpec>()[0].touch = world::Touch::nothing;
        World world(spec);
        EXPECT_NEAR(knotDeterminant(positionsOf(world, "net.knot")), 3.0, 1e-6);
        for (int i = 0; i < 120; ++i) {
            ASSERT_FALSE(world.advance());
            if (touches) ASSERT_NEAR(knotDeterminant(positionsOf(world, "net.knot")), 3.0, 1e-6) << i;
        }
        // Without contact nothing keeps it.
        if (!touches) EXPECT_NEAR(knotDeterminant(positionsOf(world, "net.knot")), 1.0, 1e-6);
    }
}

// Islands whose steps differ by seven times.
TEST(TouchingIslands, OfDifferentStepsKeepMomentum) {
    for (const auto precision : {world::Precision::double_, world::Precision::single_}) {
        world::SceneSpec spec = scene();
        spec.solver.precision = precision;
        spec.world.gravity = dvec3(0.0);
        spec.materials["steel"] = spec.materials["linen"];
        spec.materials["steel"].stretch = 2e4;
        spec.materials["steel"].dampingTime = 1e-4;
        spec.materials["linen"].dampingTime = 1e-4;
        world::ClothSpec soft = sheet("soft", {-0.15, 0.0, -0.15}, {0.3, 0, 0}, {0, 0, 0.3}, 8),
                         stiff = sheet("stiff", {-0.1, 0.03, -0.12}, {0.2, 0.01, 0.02}, {-0.02, 0.01, 0.2}, 6);
        soft.velocity = {0.0, 1.0, 0.1};
        stiff.velocity = {0.2, -1.0, 0.0};
        stiff.material = "steel";
        spec.bodies.add(soft);
        spec.bodies.add(stiff);
        World world(spec);
        EXPECT_GT(world.islands()[1].substeps, 4 * world.islands()[0].substeps);
        const world::Metrics before = world.metrics();
        double passed = 0;
        for (const char* name : {"cloth.soft", "cloth.stiff"}) passed += glm::length(world.metrics(name).momentum);
        int pressing = 0;
        for (int i = 0; i < 30; ++i) {
            ASSERT_FALSE(world.advance());
            pressing = std::max(pressing, world.contact().lastImpulses);
        }
        EXPECT_GT(pressing, 0);
        // Each step rounds velocities once more, to either side.
        const double rounding = precision == world::Precision::double_ ? 1e-16 : 6e-8;
        EXPECT_LT(glm::length(world.metrics().momentum - before.momentum),
                  rounding * std::sqrt(30.0 * world.islands()[1].substeps) * passed);
    }
}

// Every method falls on a cloth of leap-frog, which is held by its corners.
TEST(TouchingIslands, OfAnyMethodDoNotCross) {
    for (const ode::MethodInfo& method : ode::methods()) {
        if (method.name == "euler") continue;
        SCOPED_TRACE(method.name);
        world::SceneSpec spec = scene();
        world::ClothSpec lower = sheet("lower", {-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 6);
        lower.hold = {"left", "right"};
        world::ClothSpec upper = sheet("upper", {-0.1, 0.05, -0.13}, {0.2, 0.02, 0.03}, {-0.03, 0.0, 0.2}, 4);
        upper.solver.integrator = std::string(method.name);
        spec.bodies.add(lower);
        spec.bodies.add(upper);
        World world(spec);
        const PiercingWitness witness(spec, {"cloth.lower", "cloth.upper"});
        for (int i = 0; i < 45; ++i) {
            ASSERT_FALSE(world.advance());
            ASSERT_EQ(witness.count(world), 0) << i;
        }
        EXPECT_GT(lowest(positionsOf(world, "cloth.upper")), -0.3);
    }
}

// A small cloth that falls on its edge, and one that falls on it.
world::SceneSpec smallFold(world::Precision precision = world::Precision::double_) {
    world::SceneSpec spec = scene();
    spec.solver.precision = precision;
    spec.colliders = {ground(0.0)};
    world::ClothSpec cloth = sheet("flag", {0.0, 0.31, 0.0}, {0.3, 0, 0}, {0, -0.3, 0.02}, 8);
    cloth.jitter = 2e-3;
    cloth.velocity = {0.0, -1.0, 0.0};
    spec.bodies.add(cloth);
    spec.bodies.add(sheet("other", {-0.05, 0.35, -0.15}, {0.3, 0, 0}, {0, 0, 0.3}, 8));
    return spec;
}

TEST(TouchingSaving, AFoldGoesOnBitForBitFromAnyTick) {
    for (const auto precision : {world::Precision::double_, world::Precision::single_}) {
        const world::SceneSpec spec = smallFold(precision);
        World through(spec);
        std::optional<World> restored(spec);
        int pressing = 0;
        for (int i = 0; i < 45; ++i) {
            const std::vector<std::byte> bytes = through.save();
            restored.emplace(spec);
            restored->restore(bytes);
            ASSERT_FALSE(through.advance());
            ASSERT_FALSE(restored->advance());
            ASSERT_EQ(through.stateHash(), restored->stateHash()) << i;
            pressing = std::max(pressing, through.contact().lastImpulses);
        }
        EXPECT_GT(pressing, 10);
        // And for longer from the middle of it.
        World once(spec), cut(spec);
        EXPECT_FALSE(advance(once, 20));
        cut.restore(once.save());
        EXPECT_FALSE(advance(once, 20));
        EXPECT_FALSE(advance(cut, 20));
        EXPECT_EQ(once.stateHash(), cut.stateHash());
    }
}

TEST(TouchingThreads, GiveTheSameHashes) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 7}) {
        World world(smallFold(), {.threads = threads});
        EXPECT_FALSE(advance(world, 40));
        EXPECT_GT(world.contact().lastImpulses, 10);
        hashes.push_back(world.stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

// Two sheets that meet; seen from a wagon that goes by, and turned.
std::vector<dvec3> meetingOf(const dvec3& wind, const glm::dmat3& turn) {
    world::SceneSpec spec = scene();
    spec.world.gravity = dvec3(0.0);
    world::ClothSpec one = sheet("one", turn * dvec3(-0.15, 0.0, -0.15), turn * dvec3(0.3, 0, 0),
                                 turn * dvec3(0, 0, 0.3), 6),
                     two = sheet("two", turn * dvec3(-0.1, 0.03, -0.12), turn * dvec3(0.2, 0.01, 0.02),
                                 turn * dvec3(-0.02, 0.01, 0.2), 5);
    one.velocity = turn * dvec3(0.0, 0.7, 0.1) + wind;
    two.velocity = turn * dvec3(0.1, -0.7, 0.0) + wind;
    spec.bodies.add(one);
    spec.bodies.add(two);
    World world(spec);
    EXPECT_FALSE(advance(world, 20));
    std::vector<dvec3> all;
    for (const char* name : {"cloth.one", "cloth.two"})
        for (const dvec3& x : positionsOf(world, name)) all.push_back(glm::transpose(turn) * (x - world.time() * wind));
    return all;
}

TEST(TouchingFrames, AWagonSeesTheSameMotion) {
    const std::vector<dvec3> still = meetingOf(dvec3(0.0), glm::dmat3(1.0));
    EXPECT_LT(largestDifference(still, meetingOf({10.0, 0.0, 0.0}, glm::dmat3(1.0))), 1e-9);
    // A quarter about z.
    const glm::dmat3 turn(dvec3(0.0, 1.0, 0.0), dvec3(-1.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0));
    EXPECT_LT(largestDifference(still, meetingOf(dvec3(0.0), turn)), 1e-9);
}

// Three sheets in a pile, the middle one cut through: the held parts are not jerked.
TEST(TouchingCut, ThroughAPileJerksNothing) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    for (int k = 0; k < 3; ++k)
        spec.bodies.add(sheet("sheet" + std::to_string(k), {-0.15 + 0.01 * k, keep * (k + 0.6), -0.15}, {0.3, 0, 0},
                              {0.0, 0, 0.3}, 6));
    World world(spec);
    EXPECT_FALSE(advance(world, 30));
    const PiercingWitness witness(spec, {"cloth.sheet0", "cloth.sheet1", "cloth.sheet2"});
    const double before = world.metrics().maxStrain;
    world::CutAction cut;
    cut.target = "cloth.sheet1";
    cut.planePoint = dvec3(0.013, 0.0, 0.0);
    cut.planeNormal = glm::normalize(dvec3(1.0, 0.0, 0.3));
    world.apply(cut);
    EXPECT_GT(world.metrics().brokenSprings, 0);
    for (int i = 0; i < 30; ++i) {
        ASSERT_FALSE(world.advance());
        EXPECT_LT(world.metrics().maxStrain, before + 0.05) << i;
        EXPECT_EQ(witness.count(world), 0);
    }
}

// A block cut through level, whose upper half is held, and a ball between the halves: it falls on the lower one,
// the block's thickness below a place that is 0.95 of the way from a layer of points to the cut.
TEST(TouchingCut, FacesBaredInABlockAreMet) {
    world::SceneSpec spec = scene();
    spec.colliders = {ground(0.0)};
    world::BlockSpec block;
    block.name = "jelly";
    block.size = {0.2, 0.25, 0.2};
    block.cells = {4, 5, 4};
    block.position = {0.0, 0.129, 0.0};
    block.hold = {"top"};
    block.dampingTime = 5e-3;
    block.thickness = keep / 2;
    block.touch = world::Touch::others;
    spec.bodies.add(block);
    world::NetSpec net;
    net.name = "ball";
    net.drag = 0.0;
    net.thickness = keep / 2;
    net.touch = world::Touch::others;
    net.points = {{"only", {0.01, 0.125, 0.013}, 0.01, false, {}}};
    spec.bodies.add(net);
    World world(spec);
    world::CutAction cut;
    world::BodySurfaces gap(world.select("net.ball"), world.select("block.jelly"));
    cut.target = "block.jelly";
    cut.planePoint = dvec3(0.0, 0.12, 0.0);
    cut.planeNormal = dvec3(0.0, 1.0, 0.0);
    world.apply(cut);
    EXPECT_FALSE(advance(world, 60));
    double under = -1;
    for (const dvec3& x : positionsOf(world, "block.jelly"))
        if (x.y < 0.12 && std::abs(x.x) < 0.01 && std::abs(x.z) < 0.01) under = std::max(under, x.y);
    const double cutAbove = 0.95 * (0.12 - 0.104) - block.thickness;
    EXPECT_NEAR(positionsOf(world, "net.ball")[0].y - under, cutAbove + keep, 0.1 * keep);
    EXPECT_GT(under, 0.09);
    EXPECT_NEAR(gap.gap(), 0.8 * keep, 0.01 * keep);  // bared in each other, and taken apart until they may stay
    World resumed(spec);
    resumed.restore(world.save());
    EXPECT_FALSE(advance(world, 5));
    EXPECT_FALSE(advance(resumed, 5));
    EXPECT_EQ(resumed.stateHash(), world.stateHash());
}

// A block cut aslant: the upper piece slides down on the lower one with g (sin a - m cos a), or stops. Pieces that met
// at the steps of whole cells would be caught in each other. They drop onto each other by some of their thickness at
// first, and the remaining edges are a twentieth of a cell high: they brake the pressed piece.
TEST(TouchingCut, APieceSlidesOnTheCutAsCoulombSays) {
    const double slope = std::atan(0.5);
    for (const double friction : {0.0, 0.3, 0.8}) {
        world::SceneSpec spec = scene();
        spec.contact.friction = friction;
        world::BlockSpec block;
        block.name = "jelly";
        block.size = {0.4, 0.3, 0.4};
        block.cells = {8, 6, 8};
        block.position = {0.0, 0.155, 0.0};
        block.hold = {"bottom"};
        block.density = 200.0;
        block.young = 2e5;
        block.dampingTime = 1e-3;
        block.drag = 0.0;
        block.thickness = 0.003;
        block.touch = world::Touch::all;
        spec.bodies.add(block);
        World world(spec);
        world::CutAction cut;
        cut.target = "block.jelly";
        cut.planePoint = dvec3(0.0, 0.16, 0.0);
        cut.planeNormal = dvec3(0.0, std::cos(slope), std::sin(slope));
        world.apply(cut);
        const std::vector<dvec3> start = positionsOf(world, "block.jelly");
        const auto way = [&] {  // [m] down the slope, of the top
            const std::vector<dvec3> now = positionsOf(world, "block.jelly");
            double sum = 0, count = 0;
            for (std::size_t k = 0; k < now.size(); ++k) {
                if (start[k].y < 0.28) continue;
                sum += glm::dot(now[k] - start[k], dvec3(0.0, -std::sin(slope), std::cos(slope)));
                ++count;
            }
            return sum / count;
        };
        EXPECT_FALSE(advance(world, 10));
        const double first = way(), h = 10.0 / 60.0;  // [s]
        EXPECT_FALSE(advance(world, 10));
        const double second = way(), theory = 9.81 * (std::sin(slope) - friction * std::cos(slope));
        if (theory > 0) {
            const double share = (second - 2 * first) / (h * h) / theory;
            EXPECT_LT(share, 1.02) << friction;
            EXPECT_GT(share, friction > 0 ? 0.8 : 0.97) << friction;
            continue;
        }
        EXPECT_FALSE(advance(world, 10));
        EXPECT_LT(way() - second, 0.003);  // [m]
    }
}

// One that lies frozen is still there.
TEST(TouchingFreeze, AFrozenBodyIsStillMet) {
    world::SceneSpec spec = scene();
    spec.solver.onDivergence = world::OnDivergence::freeze;
    spec.solver.freezeStrain = 0.5;
    world::ClothSpec lower = sheet("lower", {-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 6);
    lower.hold = {"left"};
    lower.velocity = {60.0, 0.0, 0.0};  // too much for it at once
    spec.bodies.add(lower);
    spec.bodies.add(sheet("upper", {-0.1, 0.25, -0.1}, {0.2, 0, 0}, {0, 0, 0.2}, 4));
    World world(spec);
    const PiercingWitness witness(spec, {"cloth.lower", "cloth.upper"});
    for (int i = 0; i < 40; ++i) ASSERT_FALSE(world.advance());
    ASSERT_EQ(world.frozen().size(), 1U);
    const std::vector<dvec3> kept = positionsOf(world, "cloth.lower");
    EXPECT_LT(world.frozen()[0].time, 0.1);
    EXPECT_EQ(witness.count(world), 0);
    double middle = 0;
    for (const dvec3& x : positionsOf(world, "cloth.upper")) middle = std::max(middle, x.y);
    EXPECT_GT(middle, -0.05);  // a free fall of 0.67 s would be 2.2 m
}

TEST(TouchingSpawn, ABodyThatAppearsLandsOnAnother) {
    world::SceneSpec spec = scene();
    world::ClothSpec lower = sheet("lower", {-0.2, 0.0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 6);
    lower.hold = {"left", "right"};
    spec.bodies.add(lower);
    World world(spec);
    EXPECT_FALSE(advance(world, 10));
    world.spawn(sheet("late", {-0.1, 0.05, -0.1}, {0.2, 0, 0}, {0, 0, 0.2}, 4));
    EXPECT_FALSE(advance(world, 40));
    EXPECT_GT(lowest(positionsOf(world, "cloth.late")), lowest(positionsOf(world, "cloth.lower")));
    EXPECT_GT(lowest(positionsOf(world, "cloth.late")), -0.3);
    // And removed bodies have no contact.
    world.destroy(bodyOf(world, "cloth.lower"));
    EXPECT_FALSE(advance(world, 40));
    EXPECT_LT(highest(positionsOf(world, "cloth.late")), -1.0);
}

// The corners at which two sheets are held lie nearer than they keep: nothing can give way there.
TEST(TouchingIslands, HeldPointsNearEachOtherArePressedByNothing) {
    world::SceneSpec spec = scene();
    world::ClothSpec left = sheet("left", {0, 0, 0}, {0.3, 0, 0}, {0, -0.3, 0}, 3),
                     right = sheet("right", {0.3 + 0.9 * keep, 0, 0}, {0.3, 0, 0}, {0, -0.3, 0}, 3);
    left.hold = right.hold = {"corners"};
    spec.bodies.add(left);
    spec.bodies.add(right);
    World world(spec);
    EXPECT_FALSE(advance(world, 12));
    EXPECT_LT(fastest(world, {"cloth.left", "cloth.right"}), 5.0);
    EXPECT_GT(fastest(world, {"cloth.left", "cloth.right"}), 0.0);
}

TEST(TouchingIslands, TheOrderOfBodiesInASceneHasNoSay) {
    std::vector<std::uint64_t> hashes;
    for (const bool isTurned : {false, true}) {
        world::SceneSpec spec = scene();
        spec.colliders = {ground(0.0)};
        std::vector bodies{sheet("a", {0.0, 0.006, 0.0}, {0.2, 0, 0}, {0, 0, 0.2}, 3),
                           sheet("b", {0.03, 0.02, 0.02}, {0.2, 0, 0.02}, {-0.02, 0, 0.2}, 4)};
        if (isTurned) std::swap(bodies[0], bodies[1]);
        for (const world::ClothSpec& body : bodies) spec.bodies.add(body);
        World world(spec);
        EXPECT_FALSE(advance(world, 15));
        EXPECT_GT(world.contact().lastImpulses, 0);
        hashes.push_back(world.stateHash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// A hand leads a sheet against another at 2940 m/s, whose corners go faster where that presses beside them: the run
// ends, or the sheet stays where it was, and both say that it was contact.
TEST(TouchingFaults, AreSaidToBeOfContactAndLeaveNumbers) {
    for (const auto on : {world::OnDivergence::stop, world::OnDivergence::freeze}) {
        world::SceneSpec spec = scene();
        spec.solver.onDivergence = on;
        spec.bodies.add(sheet("led", {0.02, -0.015, 0}, {0.02, 0, 0}, {0, -0.02, 0}, 1));
        spec.bodies.add(sheet("hit", {0.0, 0.0, 0.03}, {0.3, 0, 0}, {0, -0.3, 0}, 3));
        world::GrabAction grab;
        grab.target = "cloth.led@all";
        grab.id = "hand";
        grab.rigid = true;
        world::MoveAction move;
        move.id = "hand";
        move.to = dvec3(0.03, -0.025, 49.0);
        move.over = 1.0 / 60;
        spec.actions = {grab, move};
        World world(spec);
        const auto divergence = world.advance();
        ASSERT_EQ(divergence.has_value(), on == world::OnDivergence::stop);
        if (!divergence) ASSERT_EQ(world.frozen().size(), 1U);
        const world::Divergence said = divergence ? *divergence : world.frozen()[0].divergence;
        EXPECT_EQ(said.body, "cloth.hit");
        EXPECT_NE(said.message.find("faster than 3000 m/s after contact with other bodies"), std::string::npos)
            << said.message;
        for (const dvec3& x : positionsOf(world, "cloth.hit")) EXPECT_LT(glm::length(x), 1.0);
    }
}

}  // namespace
}  // namespace taut::test::touching
