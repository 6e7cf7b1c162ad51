// Points tied to colliders: where they are carried, the effect on the rest, and their release.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "support/timelines.h"
#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/net.h"
#include "taut/core/error.h"
#include "taut/core/trig.h"
#include "taut/spec/private/rotation.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::world {
namespace {

using core::pi;
using support::run;

WeldJoint tie(const std::string& a, const std::string& b) {
    return support::weld(a, b, 0.02, {"ties.toml", 5, 1});
}

// A ball that nothing comes near to, at the origin, on keys that turn it about z evenly: a turn a second.
ColliderSpec turning(double seconds) {
    ColliderSpec spinner = support::ball("spinner", {0, 0, 0}, 0.01);
    spinner.keys = {{0.0, dvec3(0.0), dvec3(0.0), Ease::linear},
                    {seconds, dvec3(0.0), {0, 0, 2 * pi * seconds}, Ease::linear}};
    return spinner;
}

// A net of the mass m, free, and the mass p at r = (0.5, 0, 0.2).
SceneSpec pair(const std::string& method = "leapfrog", double stiffness = 40, double dt = 0) {
    SceneSpec scene;
    scene.world.gravity = dvec3(0.0);
    scene.solver.precision = Precision::double_;
    scene.solver.integrator = method;
    if (dt > 0) scene.solver.dt = dt;
    NetSpec net;
    net.name = "n";
    net.drag = 0;
    net.collide = false;
    net.points = {{"p", {0.5, 0, 0.2}, 1.0, false, {}}, {"m", {0.9, 0.1, 0.1}, 0.5, false, {}}};
    net.springs = {{"p", "m", stiffness, 0.3, 2e-3, {}}};
    scene.bodies.add(net);
    return scene;
}

SceneSpec carriedPair(const std::string& method = "leapfrog", double dt = 0) {
    SceneSpec scene = pair(method, 40, dt);
    scene.colliders = {turning(3)};
    scene.joints = {tie("net.n@p", "collider.spinner")};
    return scene;
}

// At the ends of a tick in which the rotation goes by θ, its rate is 2 sin(θ/2) a tick (world::between()).
TEST(Ties, PointsDescribeTheCircleOfTheirCollider) {
    World world(carriedPair());
    run(world, 1);
    const double angle = 2 * pi * world.tickSeconds(), speed = 0.5 * 2 * std::sin(0.5 * angle) / world.tickSeconds();
    for (int i = 0; i < 150; ++i, run(world, 1)) {
        const PointsNow now = world.points("net.n@p");
        const double at = 2 * pi * world.time();
        EXPECT_NEAR(glm::length(now.x[0] - dvec3(0.5 * std::cos(at), 0.5 * std::sin(at), 0.2)), 0, 2e-15);
        EXPECT_NEAR(glm::length(now.v[0] - speed * dvec3(-std::sin(at), std::cos(at), 0)), 0, 2e-13);
    }
    EXPECT_NEAR(speed, pi, pi * angle * angle / 24);  // ω r
}

// Moved by keys, an action, or a system.
TEST(Ties, PointsKeepTheirPlaceOnAColliderThatAnActionOrASystemMoves) {
    SceneSpec scene = pair();
    scene.colliders = {support::ball("box", {0.2, -0.1, 0}, 0.01)};
    scene.bodies[0].hold = {"p"};
    scene.bodies[0].holdOn = "collider.box";
    auto move = support::action<MoveAction>(0.1, "collider.box");
    move.to = dvec3(1, 2, 3);
    move.rotation = dvec3(0.3, -1.1, 2.0);
    move.over = 0.5;
    scene.actions = {move};
    World world(scene);
    EXPECT_EQ(world.islands()[0].heldPoints, 1);
    world.addSystem([](World& w, double t, double) {
        if (t > 0.7)
            w.registry().each<Placement>(
                [&](ecs::Entity, Placement& p) { p.to.position.x = 1 + (t - 0.7) * (t - 0.7); });
    });
    const dvec3 start = dvec3(0.5, 0, 0.2) - dvec3(0.2, -0.1, 0);
    for (int i = 0; i < 60; ++i) {
        run(world, 1);
        collision::Pose pose;
        world.registry().each<Placement>([&](ecs::Entity, const Placement& p) { pose = p.to; });
        const PointsNow now = world.points("net.n@p");
        EXPECT_NEAR(glm::length(now.x[0] - (pose.position + pose.rotation * start)), 0, 1e-14);
    }
}

class OrderThroughTies : public testing::TestWithParam<std::tuple<std::string_view, bool>> {};
INSTANTIATE_TEST_SUITE_P(Methods, OrderThroughTies,
                         testing::Combine(testing::Values("leapfrog", "velocity-verlet", "midpoint", "rk4", "sdirk2"),
                                          testing::Bool()),
                         [](const auto& parameter) {
                             std::string name(std::get<0>(parameter.param));
                             std::erase(name, '-');
                             return name + (std::get<1>(parameter.param) ? "Rigid" : "Spring");
                         });

dvec3 placeOnTheSwing(const std::string& method, bool isRigid, int substeps) {
    SceneSpec scene = pair(method, 40, 1.0 / 60 / substeps);
    scene.colliders = {turning(3)};
    scene.colliders[0].keys[1].ease = Ease::smooth;  // its spin changes from tick to tick
    if (isRigid)
        scene.joints = {tie("net.n@p", "collider.spinner")};
    else
        scene.joints = {support::springJoint("net.n@p", "collider.spinner", 100, 5e-3)};
    World world(scene);
    run(world, 60);
    return world.points("net.n@m").x[0];
}

// Against Runge-Kutta 4 at steps so short that it is exact to about 1e-11. The hanging points see it where it is
// at every stage.
TEST_P(OrderThroughTies, IsThatOfTheMethod) {
    const auto [method, isRigid] = GetParam();
    const dvec3 exact = placeOnTheSwing("rk4", isRigid, 40);
    const double coarse = glm::length(placeOnTheSwing(std::string(method), isRigid, 3) - exact);
    const double fine = glm::length(placeOnTheSwing(std::string(method), isRigid, 6) - exact);
    EXPECT_NEAR(std::log2(coarse / fine), method == "rk4" ? 4 : 2, 0.35) << coarse << ' ' << fine;
}

// Thrown off a wheel: the speed 2 sin(θ/2) r a tick, along the tangent, and from then on momentum is conserved.
TEST(Ties, FreedPointsFlyOnWithTheirVelocity) {
    SceneSpec scene = carriedPair();
    scene.bodies.of<NetSpec>()[0].springs[0].stiffness = 1e-9;
    scene.actions = {support::action<FreeAction>(0.5, "net.n@p")};
    World world(scene);
    run(world, 30);
    const PointsNow thrown = world.points("net.n@p");
    EXPECT_NEAR(thrown.v[0].y, -pi, 2e-3);
    run(world, 30);
    const PointsNow now = world.points("net.n@p");
    EXPECT_NEAR(glm::length(now.v[0] - thrown.v[0]), 0, 1e-8);  // but for the spring of 1e-9 N/m
    EXPECT_NEAR(glm::length(now.x[0] - thrown.x[0] - 0.5 * thrown.v[0]), 0, 1e-8);
}

TEST(Ties, AColliderThatIsDestroyedLetsGo) {
    World world(carriedPair());
    run(world, 20);
    ecs::Entity spinner{};
    world.registry().each<ColliderPart>([&](ecs::Entity entity, const ColliderPart&) { spinner = entity; });
    world.destroy(spinner);
    run(world, 1);
    const dvec3 momentum = world.metrics().momentum;
    run(world, 60);
    EXPECT_NEAR(glm::length(world.metrics().momentum - momentum), 0, 1e-12);
    EXPECT_EQ(world.islands()[0].heldPoints, 0);
}

// From then on, wherever the collider is by now.
TEST(Ties, PointsAreHeldOnAColliderInMidRun) {
    SceneSpec scene = carriedPair();
    scene.joints.clear();
    auto hold = support::action<HoldAction>(0.25, "net.n@p");
    hold.holdOn = "collider.spinner";
    scene.actions = {hold};
    World world(scene);
    run(world, 15);
    const dvec3 at = world.points("net.n@p").x[0];
    run(world, 15);  // half a turn less a quarter
    const dvec3 now = world.points("net.n@p").x[0];
    EXPECT_NEAR(glm::length(now - dvec3(-at.y, at.x, at.z)), 0, 1e-14);
    hold.holdOn = "collider.nobody";
    EXPECT_THROW(world.apply(hold), core::Error);
    hold.holdOn = "";
    world.apply(hold);
    run(world, 15);
    EXPECT_EQ(world.points("net.n@p").x[0], now);
}

// At the same steps; the collider is at the origin, so that not even its place is rounded.
TEST(Ties, OnAColliderThatIsStillItIsAsHeldInPlace) {
    SceneSpec scene;
    scene.solver.dt = 1.0 / 60 / 40;
    scene.bodies.add(support::cloth("sheet", 6));
    scene.bodies[0].hold = {"top"};
    scene.colliders = {support::ball("rock", {0, 0, 0}, 0.9)};
    World held(scene);
    scene.bodies[0].holdOn = "collider.rock";
    World carried(scene);
    run(held, 20);
    run(carried, 20);
    EXPECT_EQ(carried.points("cloth.sheet").x, held.points("cloth.sheet").x);
}

TEST(Ties, WeldedBodiesAreCarriedAsOne) {
    SceneSpec scene = pair();
    NetSpec other;
    other.name = "o";
    other.points = {{"q", {0.9, 0.1, 0.1}, 1.0, false, {}}, {"r", {0.9, 0.6, 0.1}, 1.0, false, {}}};
    other.springs = {{"q", "r", 10, 0.5, 1e-3, {}}};
    scene.bodies.add(other);
    scene.colliders = {turning(3)};
    scene.joints = {tie("net.n@m", "net.o@q"), tie("net.o@q", "collider.spinner"), tie("net.n@m", "collider.spinner")};
    World world(scene);
    EXPECT_EQ(world.islands().size(), 1U);
    EXPECT_EQ(world.islands()[0].heldPoints, 1);
    run(world, 15);
    for (const char* point : {"net.n@m", "net.o@q"})
        EXPECT_NEAR(glm::length(world.points(point).x[0] - dvec3(-0.1, 0.9, 0.1)), 0, 1e-14);
}

// Pulled so hard that ticks are repeated in shorter steps (see StepFollowing).
TEST(Ties, PointsAreCarriedThroughTicksThatAreRepeated) {
    SceneSpec scene;
    scene.solver.precision = Precision::double_;
    scene.bodies.add(support::stiffBlock("b"));
    scene.bodies[0].holdOn = "collider.spinner";
    scene.bodies[0].collide = false;
    scene.colliders = {turning(3)};
    scene.actions = {support::push(0.1, "block.b@top", {0, 200, 0})};
    World world(scene);
    const std::vector<dvec3> start = world.points("block.b@bottom").x;
    for (int i = 1; i <= 10; ++i) {
        run(world, 1);
        const glm::dquat turned = rotationOf({0, 0, 2 * pi * world.time()});
        const std::vector<dvec3> now = world.points("block.b@bottom").x;
        for (std::size_t p = 0; p < now.size(); ++p)
            EXPECT_NEAR(glm::length(now[p] - rotated(turned, start[p])), 0, 1e-14);
    }
    const auto changes = world.islands()[0].stepChanges;
    EXPECT_TRUE(std::any_of(changes.begin(), changes.end(), [](const StepChange& c) { return c.isRepeated; }));
}

// Drawn to a place on the collider, where it is at the start or where `place` is: once that is still the spring is
// without force there. A coil is drawn while it has a length.
TEST(Ties, ASpringDrawsAPointToAPlaceOnTheCollider) {
    for (const std::optional<dvec3>& place : {std::optional<dvec3>(), std::optional<dvec3>({0.3, 0.1, 0})}) {
        SceneSpec scene = pair();
        scene.colliders = {support::ball("arm", {0, 0, 0}, 0.01)};
        SpringJoint joint = support::springJoint("collider.arm", "net.n@p", 200, 0.1);
        joint.place = place;
        joint.look.finish.emplace();
        joint.look.turns = 3;
        scene.joints = {joint};
        scene.bodies.of<NetSpec>()[0].springs[0].dampingTime = 0.1;
        scene.bodies.of<NetSpec>()[0].drag = 4;  // so that m does not swing for ever
        auto move = support::action<MoveAction>(0.0, "collider.arm");
        move.to = dvec3(0, 1, 0);
        move.rotation = dvec3(0, 0, pi / 2);
        move.over = 0.2;
        scene.actions = {move};
        World world(scene);
        const auto coils = [&] {
            const auto surfaces = world.view(false).surfaces;
            return std::count_if(surfaces.begin(), surfaces.end(),
                                 [](const view::Surface& surface) { return surface.name.starts_with("joint."); });
        };
        EXPECT_EQ(coils(), place ? 1 : 0);
        run(world, 900);
        EXPECT_EQ(coils(), 0);
        const dvec3 end = place ? dvec3(-0.1, 1.3, 0) : dvec3(0, 1.5, 0.2);
        EXPECT_NEAR(glm::length(world.points("net.n@p").x[0] - end), 0, 1e-9);
        EXPECT_NEAR(world.metrics().energy(), 0, 1e-9);
    }
}

TEST(Ties, ABodyThatIsSpawnedIsTiedWhereTheColliderThenIs) {
    SceneSpec scene = carriedPair();
    scene.actions = {support::action<SpawnAction>(0.25, "net.n")};
    World world(scene);
    run(world, 30);
    EXPECT_NEAR(glm::length(world.points("net.n@p").x[0] - dvec3(0, 0.5, 0.2)), 0, 1e-14);
}

// A cloth that is carried and drawn, freed and held elsewhere, beside a collider in its way.
SceneSpec muchIsTied(const std::string& method) {
    SceneSpec scene;
    scene.solver.integrator = method;
    if (method == "implicit-euler") scene.solver.dt = 1.0 / 240;
    scene.bodies.add(support::cloth("sheet", 6));
    scene.bodies[0].hold = {"top"};
    scene.bodies[0].holdOn = "collider.spinner";
    scene.colliders = {turning(3), support::ball("rock", {0.5, 0.8, 0.1}, 0.3), support::ball("arm", {0, 0, 1}, 0.1)};
    scene.joints = {support::springJoint("cloth.sheet@bottom-left", "collider.arm", 20, 1e-4)};
    auto move = support::action<MoveAction>(0.1, "collider.arm");
    move.to = dvec3(0, 1, 1);
    move.rotation = dvec3(1, 1, 0);
    move.over = 0.3;
    auto hold = support::action<HoldAction>(0.3, "cloth.sheet@bottom-right");
    hold.holdOn = "collider.arm";
    auto turn = support::moveHand(0.2, {0, 2, 0.2}, 0.2);
    turn.rotation = dvec3(0, 3, 0);
    scene.actions = {support::grab(0.1, "cloth.sheet@(0.5,0.5)", true), move, turn,
                     support::action<FreeAction>(0.25, "cloth.sheet@top-left"), hold};
    return scene;
}

class SavedTies : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Methods, SavedTies, testing::Values("leapfrog", "velocity-verlet", "implicit-euler"),
                         [](const auto& parameter) {
                             std::string name(parameter.param);
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(SavedTies, GoOnBitForBitFromAnyTick) {
    const SceneSpec scene = muchIsTied(std::string(GetParam()));
    World through(scene);
    std::vector<std::vector<std::byte>> saved;
    for (int i = 0; i < 30; ++i) {
        saved.push_back(through.save());
        run(through, 1);
    }
    for (std::size_t from = 0; from < saved.size(); ++from) {
        World restored(scene);
        restored.restore(saved[from]);
        EXPECT_EQ(restored.save(), saved[from]) << from;
        run(restored, 30 - static_cast<int>(from));
        EXPECT_EQ(restored.stateHash(), through.stateHash()) << from;
        EXPECT_EQ(restored.metrics().kinetic, through.metrics().kinetic) << from;
    }
}

std::uint64_t hashWith(int threads) {
    SceneSpec scene = muchIsTied("leapfrog");
    scene.bodies.of<ClothSpec>()[0].cells = {80, 80};  // of several chunks
    World world(scene, {.threads = threads});
    run(world, 20);
    return world.stateHash();
}

TEST(Ties, AreTheSameWithAnyThreads) {
    EXPECT_EQ(hashWith(1), hashWith(3));
}

std::string refusal(const SceneSpec& scene) {
    try {
        World world(scene);
    } catch (const core::Error& error) {
        return error.what();
    }
    return "";
}

TEST(Ties, ImpossibleTiesAreRefused) {
    SceneSpec scene = carriedPair();
    const auto with = [&](const WeldJoint& joint) {
        SceneSpec other = scene;
        other.joints.add(joint);
        return refusal(other);
    };
    const std::string place = "ties.toml:5:1: error: ";
    EXPECT_EQ(with(tie("net.n@m", "collider.nobody")),
              place + "there is no collider.nobody to tie points to; add a table [collider.nobody]");
    EXPECT_EQ(with(tie("collider.spinner", "collider.spinner")),
              place +
                  "both sides of the joint \"collider.spinner\" – \"collider.spinner\" are colliders; one has to be "
                  "points of a body");
    EXPECT_EQ(with(tie("net.n@q", "collider.spinner")), place + "\"net.n@q\" names no point");
    EXPECT_EQ(with(tie("net.n@p", "collider.spinner")), "");  // once more the same
    scene.colliders.push_back(support::ball("other", {0, 0, 0}, 0.1));
    EXPECT_EQ(with(tie("net.n@p", "collider.other")),
              place +
                  "point #0 of net.n is tied to collider.spinner already and cannot go with collider.other too; "
                  "take different points");
    scene.bodies[0].hold = {"m"};
    EXPECT_EQ(with(tie("net.n@m", "collider.other")),
              place +
                  "point #1 of net.n is held in place and cannot go with collider.other too; take it out of `hold`, "
                  "or give the body hold_on = \"collider.other\"");
}

// A place is in the axes of the collider, which stands at (0, 1, 0), turned by a quarter about z. At rest a spring of
// 200 N/m that bears 1 kg is longer by g/200; a rod keeps its length; a weld starts at its place.
TEST(Ties, APlaceIsInTheAxesOfTheColliderForEveryKind) {
    const dvec3 place(0.3, 0.1, 0), there(-0.1, 1.3, 0);
    const auto sceneOf = [&](auto joint) {
        SceneSpec scene;
        scene.solver.precision = Precision::double_;
        NetSpec net;
        net.name = "n";
        net.drag = 4;
        net.points = {{"p", there - dvec3(0, 0.01, 0), 1, false, {}}};
        scene.bodies.add(net);
        scene.colliders = {support::ball("arm", {0, 1, 0}, 0.01)};
        scene.colliders[0].rotation = {0, 0, pi / 2};
        joint.a = "collider.arm";
        joint.b = "net.n@p";
        joint.place = place;
        scene.joints.add(joint);
        return scene;
    };
    const auto restsAt = [](SceneSpec scene) {
        World world(scene);
        run(world, 900);
        EXPECT_NEAR(world.metrics().kinetic, 0, 1e-12);
        return world.points("net.n@p").x[0];
    };
    SpringJoint spring;
    spring.stiffness = 200;
    spring.dampingTime = 0.1;
    for (const double length : {0.0, 0.4}) {
        spring.restLength = length;
        EXPECT_NEAR(glm::length(restsAt(sceneOf(spring)) - (there - dvec3(0, length + support::g / 200, 0))), 0, 1e-9);
    }
    EXPECT_NEAR(glm::length(restsAt(sceneOf(RodJoint())) - (there - dvec3(0, 0.01, 0))), 0, 1e-12);
    for (const std::string name : {"", "pin"}) {  // carried, or pinned
        WeldJoint weld;
        weld.name = name;
        EXPECT_NEAR(glm::length(restsAt(sceneOf(weld)) - there), 0, 1e-12) << name;
    }
    WeldJoint weld;
    SceneSpec far = sceneOf(weld);
    far.bodies.of<NetSpec>()[0].points[0].position.y -= 1;
    EXPECT_NE(refusal(far).find("place is 1.010000 m from point #0 of net.n, further than a weld reaches"),
              std::string::npos)
        << refusal(far);
}

TEST(Ties, AnIslandThatIsFrozenStaysWhereItIs) {
    SceneSpec scene = carriedPair("leapfrog", 0.25 / 60);
    scene.solver.onDivergence = OnDivergence::freeze;
    scene.solver.freezeStrain = 0.5;
    scene.actions = {support::push(0.1, "net.n@m", {20, 0, 0})};
    World world(scene);
    run(world, 30);
    ASSERT_EQ(world.frozen().size(), 1U);
    const dvec3 at = world.points("net.n@p").x[0];
    run(world, 30);
    EXPECT_EQ(world.points("net.n@p").x[0], at);
}

}  // namespace
}  // namespace taut::world
