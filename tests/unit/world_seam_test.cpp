// Seams: which points they pair, how they close, which surfaces then have contact, how they come apart, refused seams.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "support/timelines.h"
#include "taut/mechanics/builders.h"
#include "taut/plan/private/seam_pairing.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::world::seams {
namespace {

using support::run;
using Pairs = std::vector<SewnPair>;

std::vector<dvec3> line(int points, const dvec3& from, const dvec3& to) {
    std::vector<dvec3> x;
    for (int i = 0; i < points; ++i) x.push_back(from + (i / (points - 1.0)) * (to - from));
    return x;
}

SewnEdge edgeOf(const std::vector<dvec3>& places, bool isClosed = false) {
    SewnEdge edge{places, {}};
    for (std::size_t i = isClosed ? 0 : 1; i < places.size(); ++i) {
        const dvec3 d = places[(i + (isClosed ? 1 : 0)) % places.size()] - places[isClosed ? i : i - 1];
        edge.steps.push_back(std::sqrt(glm::dot(d, d)));
    }
    return edge;
}

Pairs paired(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
    return pairedByLength(edgeOf(a), edgeOf(b));
}

// "0-5 0.6*0+0.4*1-4": pairs of places, and of places between two.
std::string textOf(const Pairs& pairs) {
    const auto spot = [](const Spot& end) {
        std::vector<Spot::Share> shares(end.shares().begin(), end.shares().end());
        std::sort(shares.begin(), shares.end(), [](const auto& a, const auto& b) { return a.point < b.point; });
        std::string all;
        for (const auto& [place, weight] : shares)
            all += (all.empty() ? "" : "+") + (end.isPoint() ? "" : fmt::format("{:.3g}*", weight)) +
                   std::to_string(place);
        return all;
    };
    std::string all;
    for (const auto& [a, b] : pairs) all += (all.empty() ? "" : " ") + spot(a) + "-" + spot(b);
    return all;
}

TEST(SeamPairing, PairsEqualEdgesPointByPointInTheNearerDirection) {
    const auto a = line(4, {0, 0, 0}, {0, 3, 0});
    EXPECT_EQ(paired(a, line(4, {1, 0, 0}, {1, 3, 0})), (Pairs{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
    EXPECT_EQ(paired(a, line(4, {1, 3, 0}, {1, 0, 0})), (Pairs{{0, 3}, {1, 2}, {2, 1}, {3, 0}}));
}

// Of a longer edge with more points each goes with the spot at the same share of the length; so from either side.
TEST(SeamPairing, GathersTheFinerEdgeEvenly) {
    const auto few = line(3, {0, 0, 0}, {0, 2, 0}), many = line(6, {1, 4, 0}, {1, 0, 0});
    EXPECT_EQ(textOf(paired(few, many)), "0-5 0.6*0+0.4*1-4 0.2*0+0.8*1-3 0.8*1+0.2*2-2 0.4*1+0.6*2-1 2-0");
    EXPECT_EQ(textOf(paired(many, few)), "0-2 1-0.4*1+0.6*2 2-0.8*1+0.2*2 3-0.2*0+0.8*1 4-0.6*0+0.4*1 5-0");
}

TEST(SeamPairing, LeavesNoPointOfAnUnevenEdgeAlone) {
    const std::vector<dvec3> uneven{{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0}, {0, 3, 0}};
    EXPECT_EQ(textOf(paired(uneven, line(4, {1, 0, 0}, {1, 3, 0}))),
              "0-0 1-0.9*0+0.1*1 2-0.8*0+0.2*1 0.357*2+0.643*3-2 3-3");
}

// A square, and another that begins at another corner and runs the other way, with the middles of two sides.
TEST(SeamPairing, TurnsAClosedEdgeToWhereItLiesNearest) {
    const SewnEdge square = edgeOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, true);
    const SewnEdge other = edgeOf({{2, 2, 1}, {2, 1, 1}, {2, 0, 1}, {0, 0, 1}, {0, 1, 1}, {0, 2, 1}}, true);
    EXPECT_EQ(textOf(pairedByLength(square, other)), "0-3 1-2 0.5*1+0.5*2-1 2-0 3-5 0.5*0+0.5*3-4");
    EXPECT_EQ(textOf(pairedByLength(other, square)), "3-0 2-1 1-0.5*1+0.5*2 0-2 5-3 4-0.5*0+0.5*3");
}

TEST(SeamPairing, BothEndsOfALineMeetAroundAClosedEdge) {
    const SewnEdge square = edgeOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, true);
    const SewnEdge strip = edgeOf({{2, 0, 1}, {2, 2, 1}, {0, 2, 1}, {0, 0, 1}, {2, 0, 2}});
    EXPECT_EQ(pairedByLength(square, strip), (Pairs{{1, 0}, {2, 1}, {3, 2}, {0, 3}, {1, 4}}));
}

TEST(SeamPairing, AnEdgeIsALineOrALoop) {
    mechanics::ClothShape shape;
    shape.cells = {3, 2};
    const mechanics::Model cloth = mechanics::buildCloth(shape);
    const auto lineAt = [&](const char* group) { return lineOf(cloth, cloth.groups.at(group)).points; };
    const auto lineOf = [&](const std::vector<int>& points) { return world::lineOf(cloth, points).points; };
    EXPECT_EQ(lineAt("right"), (std::vector{3, 7, 11}));
    EXPECT_EQ(lineOf({6, 4, 5, 7}), (std::vector{4, 5, 6, 7}));        // threads, inside
    EXPECT_EQ(lineOf({8, 4, 0, 1, 2}), (std::vector{2, 1, 0, 4, 8}));  // around a corner
    EXPECT_TRUE(lineAt("all").empty());
    EXPECT_EQ(lineAt("edges"), (std::vector{0, 1, 2, 3, 7, 11, 10, 9, 8, 4}));  // a loop
    EXPECT_TRUE(world::lineOf(cloth, cloth.groups.at("edges")).isClosed);
    EXPECT_TRUE(lineAt("top-left").empty());    // a point
    EXPECT_TRUE(lineOf({0, 1, 8, 9}).empty());  // two lines
    EXPECT_TRUE(lineOf({4, 5, 6, 9}).empty());  // a fork
}

// Two panels side by side in free space, `apart` [m], the second of other cells.
std::string panels(const std::string& apart, const std::string& seam, const std::string& more = "") {
    const std::string panel = "material = \"m\"\nthickness = 0.01\ntouch = \"all\"\nsize = [0.3, 0.4]\n";
    return "schema = 1\n[run]\nfps = 100\nseconds = 10\n[solver]\nprecision = \"double\"\n[world]\n"
           "gravity = [0, 0, 0]\n[material.m]\ndrag_per_s = 0\n[cloth.a]\ncells = [3, 4]\norigin = [-0.3, 1, 0]\n" +
           panel + "[cloth.b]\ncells = [3, 6]\norigin = [" + apart + ", 1, 0]\n" + panel + more +
           "[[seam]]\na = \"cloth.a@right\"\nb = \"cloth.b@left\"\n" + seam;
}

SceneSpec sceneOf(const std::string& text) {
    return scene::loadSceneText(text, "seams.toml", {}).spec;
}

double lengthOf(const dvec3& d) {
    return std::sqrt(glm::dot(d, d));
}

// The largest distance of a point of the finer edge from its place on the other, at the same share of the length.
double gap(const World& world) {
    const auto a = world.points("cloth.a@right").x, b = world.points("cloth.b@left").x;
    const std::size_t last = a.size() - 1;
    double most = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const std::size_t whole = i * last / (b.size() - 1), next = std::min(whole + 1, last);
        const double share = static_cast<double>(i * last % (b.size() - 1)) / static_cast<double>(b.size() - 1);
        most = std::max(most, lengthOf(b[i] - (1 - share) * a[whole] - share * a[next]));
    }
    return most;
}

TEST(Seams, CloseInTheirTimeAndKeepMomentum) {
    World world(sceneOf(panels("0.2", "over_s = 1.0\n", "velocity = [0, 0, 0.5]\n")));
    const Metrics before = world.metrics();
    const double start = gap(world);
    for (const double share : {0.25, 0.5, 0.75}) {
        run(world, 25);
        const double most = start * (1 - share) * (1 - share) * (1 + 2 * share);
        EXPECT_LT(gap(world), most * (1 + 1e-6)) << share;  // a start that is a little nearer may lag by that
        EXPECT_GT(gap(world), 0.5 * most) << share;
    }
    run(world, 25);
    EXPECT_LT(gap(world), 1e-14);
    run(world, 50);
    EXPECT_LT(gap(world), 1e-14);
    const Metrics after = world.metrics();
    EXPECT_LT(lengthOf(after.momentum - before.momentum), 1e-12);
    EXPECT_EQ(after.crossings, 0);
}

// They lie flat side by side, much nearer than their thickness.
// The panels drift apart until then.
TEST(Seams, MayBeginLater) {
    const std::string drifts = "velocity = [0.5, 0, 0]\n";
    const SceneSpec scene = sceneOf(panels("0.2", "start_s = 0.405\nover_s = 0.4\n", drifts));
    World world(scene);
    const double start = gap(world);
    const dvec3 momentum = world.metrics().momentum;
    run(world, 40);
    const double drifted = gap(world);
    EXPECT_GT(drifted, start + 0.19);
    for (const int ticks : {10, 10}) {  // from before it begins and from after
        World other(scene);
        other.restore(world.save());
        run(world, ticks);
        run(other, ticks);
        EXPECT_EQ(world.save(), other.save());
    }
    const double share = (0.6 - 0.405) / 0.4, most = (drifted + 0.005) * (1 - share) * (1 - share) * (1 + 2 * share);
    EXPECT_LT(gap(world), most * 1.001);
    EXPECT_GT(gap(world), 0.8 * most);
    run(world, 21);
    EXPECT_LT(gap(world), 1e-14);
    EXPECT_LT(lengthOf(world.metrics().momentum - momentum), 1e-12);
}

// A tube of two panels, and a wider one of one panel about it, whose upper edges go around.
TEST(Seams, CloseAroundWhatOtherSeamsHaveClosed) {
    const auto seam = [](const std::string& a, const std::string& b) {
        return "[[seam]]\na = " + a + "\nb = " + b + "\nover_s = 0.2\n";
    };
    const std::string panel = "material = \"m\"\nthickness = 0.002\n";
    World world(sceneOf(
        "schema = 1\n[run]\nfps = 100\nseconds = 1\n[solver]\nprecision = \"double\"\n[world]\n"
        "gravity = [0, 0, 0]\n[material.m]\ndrag_per_s = 0\n[cloth.front]\nsize = [0.3, 0.2]\n"
        "cells = [3, 2]\norigin = [-0.15, 1, 0.1]\n" +
        panel +
        "[cloth.back]\nlike = \"front\"\norigin = [0.15, 1, -0.1]\nacross = [-1, 0, 0]\n"
        "[cloth.sleeve]\nsize = [0.6, 0.2]\ncells = [6, 2]\norigin = [-0.3, 1.4, 0.2]\n" +
        panel + seam("\"cloth.front@left\"", "\"cloth.back@right\"") +
        seam("\"cloth.front@right\"", "\"cloth.back@left\"") + seam("\"cloth.sleeve@left\"", "\"cloth.sleeve@right\"") +
        seam("[\"cloth.back@top\", \"cloth.front@top\"]", "\"cloth.sleeve@bottom\"")));
    const auto at = [&](const char* name) { return world.points(name).x; };
    run(world, 30);
    const auto front = at("cloth.front@top"), back = at("cloth.back@top"), sleeve = at("cloth.sleeve@bottom");
    std::set<std::size_t> partners;
    for (const auto& row : {front, back})
        for (const dvec3& x : row)
            for (std::size_t j = 0; j < sleeve.size(); ++j)
                if (lengthOf(sleeve[j] - x) < 1e-14) partners.insert(j);
    EXPECT_EQ(partners.size(), sleeve.size());
    EXPECT_LT(lengthOf(sleeve.front() - sleeve.back()), 1e-14);
    EXPECT_LT(lengthOf(front.front() - back.back()), 1e-14);
    EXPECT_LT(lengthOf(world.metrics().momentum), 1e-12);
}

TEST(Seams, NothingBesideThemTouches) {
    World world(sceneOf(panels("0.2", "over_s = 0.3\n")));
    for (int tick = 0; tick < 60; ++tick) {
        run(world, 1);
        EXPECT_EQ(world.metrics().bodyContacts, 0) << tick;
    }
    EXPECT_LT(gap(world), 1e-14);
    EXPECT_FALSE(world.hasTouched());
}

TEST(Seams, GoOnWithTheSameBitsFromTheMiddle) {
    const SceneSpec scene = sceneOf(panels("0.2", "over_s = 0.3\nname = \"s\"\n"));
    World world(scene);
    for (const int ticks : {10, 25}) {  // before and after it closes
        run(world, ticks);
        World other(scene);
        other.restore(world.save());
        run(other, 25);
        run(world, 25);
        EXPECT_EQ(world.save(), other.save());
    }
}

TEST(Seams, AreClosedAtOnceWhereTheyMeet) {
    World merged(sceneOf(panels("0.0", ""))), named(sceneOf(panels("0.001", "name = \"s\"\n")));
    EXPECT_EQ(merged.islands().front().points, 4 * 5 + 4 * 7 - 3);  // both ends and the middle
    EXPECT_EQ(named.islands().front().points, 4 * 5 + 4 * 7);
    EXPECT_LT(gap(merged), 1e-15);
    EXPECT_LT(gap(named), 1e-15);
    EXPECT_EQ(named.joints().front().kind, "seam");
    EXPECT_EQ(named.joints().front().pairs.at(0).points, 7);
}

// Edges of 17 and 32 points, of one length, as they meet and drawn together: no cell is stretched, so both edges have
// their lengths. They vibrate a little when a seam has drawn them.
TEST(Seams, KeepTheSizeOfUnlikeCells) {
    for (const auto& [apart, seam, most] :
         {std::tuple{"0.0", "", 1e-12}, {"0.0", "name = \"s\"\n", 1e-12}, {"0.05", "over_s = 0.5\n", 1e-3}}) {
        std::string text = panels(apart, seam);
        text.replace(text.find("[3, 4]"), 6, "[3, 16]");
        text.replace(text.find("[3, 6]"), 6, "[3, 31]");
        text.replace(text.find("drag_per_s = 0"), 14, "drag_per_s = 9");
        World world(sceneOf(text));
        EXPECT_TRUE(world.warnings().empty()) << world.warnings().front().text;
        run(world, 100);
        EXPECT_LT(gap(world), 1e-14) << seam;
        for (const char* edge : {"cloth.a@right", "cloth.b@left"}) {
            const std::vector<dvec3> x = world.points(edge).x;
            for (std::size_t i = 1; i < x.size(); ++i)
                EXPECT_NEAR(lengthOf(x[i] - x[i - 1]) * static_cast<double>(x.size() - 1), 0.4, 0.4 * most)
                    << edge << seam << i;
        }
    }
}

TEST(Seams, WarnOfEdgesThatCannotBeSewn) {
    const auto warnings = [](const std::string& text) { return printed(World(sceneOf(text)).warnings()); };
    std::string even = panels("0.2", "over_s = 1\n");
    EXPECT_TRUE(warnings(even).empty());
    even.replace(even.find("[3, 6]"), 6, "[3, 4]");
    EXPECT_TRUE(warnings(even).empty());
    const auto expectWarning = [&](std::string text, const std::string& from, const std::string& to,
                                   const std::string& what) {
        text.replace(text.rfind(from), from.size(), to);
        ASSERT_FALSE(warnings(text).empty()) << what;
        EXPECT_NE(warnings(text).back().find(what), std::string::npos) << warnings(text).back();
    };
    expectWarning(even, "[0.3, 0.4]", "[0.3, 1.4]", "sews 0.4 m to 1.4 m");
    expectWarning(even, "\"cloth.b@left\"", "[\"cloth.b@left\", \"cloth.b@right\"]", "leaves a gap of 0.3 m");
    for (std::size_t at = even.find("size"); at != std::string::npos; at = even.find("\nsize", at + 40))
        even.insert(at == even.find("size") ? at : at + 1, "hold = [\"all\"]\n");
    ASSERT_EQ(warnings(even).size(), 1U);
    EXPECT_NE(warnings(even)[0].find("does not close: 5 of its points"), std::string::npos) << warnings(even)[0];
}

// A panel whose edge is bent twice, sewn to two that meet where the bends do: each of these has a corner there, and the
// seam's ends; drawn smooth by itself, the edge of the first would be round where theirs are not.
TEST(Seams, AreDrawnWithoutGapsWhereEdgesAreSmooth) {
    std::string text = "schema = 1\n[world]\ngravity = [0, 0, 0]\n[material.m]\n";
    for (const auto& [name, outline] : {std::pair("whole", "[[0, 0], [0.1, 0.03], [0.2, 0], [0.2, -0.1], [0, -0.1]]"),
                                        std::pair("one", "[[0, 0], [0.1, 0.03], [0.1, 0.1], [0, 0.1]]"),
                                        std::pair("two", "[[0.1, 0.03], [0.2, 0], [0.2, 0.1], [0.1, 0.1]]")})
        text += std::string("[cloth.") + name + "]\nmaterial = \"m\"\noutline = " + outline +
                "\ncell_m = 0.02\nfinish = { smooth = 1 }\n";
    text +=
        "[[seam]]\na = \"cloth.whole@side0\"\nb = \"cloth.one@side0\"\n"
        "[[seam]]\na = \"cloth.whole@side1\"\nb = \"cloth.two@side0\"\n"
        "[[seam]]\na = \"cloth.one@side1\"\nb = \"cloth.two@side3\"\n";
    const World world(sceneOf(text));
    const auto placesOf = [&](const std::string& name) {
        for (const view::Surface& surface : world.view(false).surfaces)
            if (surface.name == name) return surface.geometry->positions;
        return std::vector<glm::vec3>();
    };
    const std::vector<glm::vec3> whole = placesOf("cloth.whole");
    for (const char* name : {"cloth.one", "cloth.two"}) {
        int met = 0;
        for (const glm::vec3& place : placesOf(name)) {
            float nearest = 1.0F;
            for (const glm::vec3& other : whole) nearest = std::min(nearest, glm::distance(place, other));
            met += nearest < 1e-6F ? 1 : 0;
            EXPECT_TRUE(nearest < 1e-6F || nearest > 3e-3F) << name << " " << nearest;
        }
        EXPECT_GE(met, 9) << name;  // five points or more, and their middles
    }
}

// Of two panels the coarser side gets the points of the finer; a panel gets those of a grid, whose cells are given. A
// panel whose cells would differ too much stays as it is, and points of the other go between its own.
TEST(Seams, GivePanelsThePointsOfWhatTheyAreSewnTo) {
    const auto worldOf = [](const std::string& seam, const std::string& cell) {
        return World(
            sceneOf("schema = 1\n[material.m]\n"
                    "[cloth.coarse]\nmaterial = \"m\"\ncell_m = " +
                    cell +
                    "\norigin = [0, 0, 0.1]\n"
                    "outline = [[0, 0], [0.3, 0], [0.34, 0.2], [0.3, 0.4], [0, 0.4]]\n"
                    "edges = [{ name = \"bent\", corners = [1, 3] }]\n"
                    "[cloth.fine]\nmaterial = \"m\"\ncell_m = 0.04\n"
                    "outline = [[0.3, 0], [0.6, 0], [0.6, 0.46], [0.3, 0.46]]\n"
                    "[cloth.grid]\nmaterial = \"m\"\nsize = [0.3, 0.42]\ncells = [4, 7]\norigin = [-0.3, 0.4, 0]\n"
                    "[[seam]]\nover_s = 1.0\n" +
                    seam));
    };
    const std::string toFine = "a = \"cloth.coarse@bent\"\nb = \"cloth.fine@side3\"\n";
    const std::string toGrid = "a = \"cloth.grid@right\"\nb = \"cloth.coarse@side4\"\n";
    for (const auto& [seam, points] : {std::pair{toFine, 13}, {toGrid, 8}}) {
        const World world = worldOf(seam, "0.05");
        EXPECT_EQ(world.joints().front().pairs.at(0).points, points);
        EXPECT_TRUE(world.warnings().empty()) << world.warnings().front().text;
    }
    const World unlike = worldOf(toFine, "0.1");
    EXPECT_EQ(unlike.joints().front().pairs.at(0).points, 13);
    EXPECT_TRUE(unlike.warnings().empty());
}

TEST(Seams, ComeApartWhenReleasedTornOrCut) {
    const std::string leaves = "velocity = [1, 0, 0]\n";
    const auto at = [](const std::string& action) { return "[[at]]\nt = 0.4\n" + action; };
    for (const auto& [name, apart, seam, more, left] :
         {std::tuple{"holds", "0.02", "over_s = 0.3\nbreak_N = 1e9\n", leaves, 7},
          {"torn", "0.02", "over_s = 0.3\nbreak_N = 0.1\n", leaves, 0},
          {"released", "0.02", "over_s = 0.3\nname = \"s\"\n", leaves + at("do = \"release\"\nid = \"s\"\n"), 0},
          {"cut while it closes", "0.2", "over_s = 0.6\n",
           at("do = \"cut\"\ntarget = \"cloth.*\"\nplane = [[0.1, 1, 0], [1, 0, 0]]\n"), 0}}) {
        World world(sceneOf(panels(apart, seam, more)));
        run(world, 100);
        EXPECT_EQ(world.joints().front().left, left) << name;
        EXPECT_EQ(gap(world) < 1e-14, left > 0) << name << gap(world);
        EXPECT_EQ(world.metrics().brokenSprings, 7 - left) << name;
    }
}

TEST(Seams, ImpossibleSeamsAreRefused) {
    const auto messageOf = [](const std::string& text) -> std::string {
        try {
            World world(sceneOf(text));
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            return error.what();
        }
        return "";
    };
    const auto with = [](const std::string& a, const std::string& b, const std::string& more = "") {
        const std::string text = panels("0.2", "");
        return text.substr(0, text.find("[[seam]]")) + "[[seam]]\na = " + a + "\nb = " + b + "\n" + more;
    };
    const std::string left = "\"cloth.b@left\"";
    for (const auto& [text, message] :
         {std::pair{with("\"cloth.a@righ\"", left), "cloth.a has no points \"righ\""},
          {with("\"cloth.c@right\"", left), "there is no cloth.c"},
          {with("\"cloth.a@right\"", left, "start_s = 1\n"), "over_s = 0.5"},
          {with("[\"cloth.a@right\", \"cloth.a@edges\"]", left, "over_s = 1\n"),
           "\"cloth.a@edges\" is closed, so no edge follows it; name it alone"},
          {with("\"cloth.*@right\"", left, "over_s = 1\n"),
           "seams.toml:25:1: error: \"cloth.*@right\" names edges of several bodies; name them in a list, as they "
           "follow each other"},
          {with("\"cloth.a@all\"", left, "over_s = 1\n"),
           "seams.toml:25:1: error: \"cloth.a@all\" is no edge to sew: its points are not one line; name a part of "
           "it, as @left of a cloth"},
          {with(left, left), "seams.toml:25:1: error: the seam sews \"cloth.b@left\" to itself; name two edges"},
          {with("\"cloth.a@right\"", left),
           "seams.toml:25:1: error: the seam \"cloth.a@right\" – \"cloth.b@left\" starts 0.200000 m apart; give the "
           "time to close, e.g. over_s = 1.0"},
          {with("\"collider.k\"", left, "[collider.k]\nshape = \"sphere\"\n"), "collider.k"}})
        EXPECT_NE(messageOf(text).find(message), std::string::npos) << messageOf(text);
}

}  // namespace
// Two panels sewn round a post that is too thick for them: they press on it, and nothing moves. Each pulls at the seam
// along itself, and only the rest of the two pulls presses.
TEST(Seams, ATautSeamRoundAPostHasNoVelocity) {
    const std::string more = "cells = [6, 2]\nmaterial = \"m\"\nthickness = 0.004\n";
    World world(sceneOf(
        "schema = 1\n[solver]\nprecision = \"double\"\n[world]\ngravity = [0, 0, 0]\n[material.m]\ndrag_per_s = 5\n"
        "[collider.post]\nshape = \"capsule\"\nradius = 0.13\nheight = 0.6\nposition = [0, 1, 0]\n"
        "[cloth.a]\nsize = [0.34, 0.1]\norigin = [-0.17, 1.05, 0.18]\n" +
        more + "[cloth.b]\nsize = [0.34, 0.1]\norigin = [0.17, 1.05, -0.18]\nacross = [-1, 0, 0]\n" + more +
        "[[seam]]\na = \"cloth.a@left\"\nb = \"cloth.b@right\"\nover_s = 0.3\n"
        "[[seam]]\na = \"cloth.a@right\"\nb = \"cloth.b@left\"\nover_s = 0.3\n"));
    for (int i = 0; i < 90; ++i) ASSERT_FALSE(world.advance());
    const std::vector<dvec3> before = world.points("cloth.a").x;
    ASSERT_FALSE(world.advance());
    const std::vector<dvec3> x = world.points("cloth.a").x;
    const PointsNow now = world.points("cloth.a");
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_LT(lengthOf(x[i] - before[i]), 1e-9) << i;
        EXPECT_LT(lengthOf(now.v[i]), 1e-6) << i;
    }
}

}  // namespace taut::world::seams
