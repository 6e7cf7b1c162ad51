// Ties to colliders in scene files: the values read, and the errors.
#include "taut/spec/actions.h"
#include "taut/world/world.h"
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

const std::string figure =
    "[collider.figure]\n"
    "shape = \"sphere\"\n"
    "position = [0, 1, 0]\n"
    "[cloth.cape]\n"
    "cells = [2, 2]\n"
    "size = [1, 1]\n"
    "material = \"m\"\n"
    "[material.m]\n"
    "[rope.r]\n"
    "ends = [[0, 3, 0], [1, 3, 0]]\n";

TEST(SceneTies, AreReadWithTheirKeys) {
    const AssetFolder folder;
    const auto loaded = folder.load(
        "schema = 1\n"
        "at = [{ t = 1, do = \"hold\", target = \"rope.r@end\", hold_on = \"collider.figure\" },\n"
        "      { t = 1, do = \"grab\", id = \"h\", target = \"rope.r@50%\" },\n"
        "      { t = 1, do = \"move\", id = \"h\", rotation_deg = [1440, 0, 0], over_s = 2 }]\n" +
        figure +
        "[cloth.cape.finish]\n"
        "[[joint]]\n"
        "a = \"collider.figure\"\n"
        "b = \"rope.r@start\"\n"
        "kind = \"spring\"\n"
        "stiffness_N_per_m = 7\n"
        "[[joint]]\n"
        "a = \"cloth.cape@top\"\n"
        "b = \"collider.figure\"\n");
    const world::World world(loaded.spec);
    const auto joints = world.joints();
    ASSERT_EQ(joints.size(), 2U);
    EXPECT_EQ(joints[0].kind, "spring");
    EXPECT_EQ(joints[0].pairs.at(0).a, "rope.r");
    EXPECT_EQ(joints[0].pairs.at(0).b, "collider.figure");
    EXPECT_EQ(joints[1].kind, "weld");
    EXPECT_EQ(joints[1].pairs.at(0).points, 3);
    EXPECT_EQ(world.islands()[0].heldPoints, 3);
    EXPECT_EQ(loaded.spec.actions.of<world::HoldAction>()[0].holdOn, "collider.figure");
    EXPECT_NEAR(loaded.spec.actions.of<world::MoveAction>()[0].rotation->x, 8 * 3.14159265358979, 1e-12);
}

TEST(SceneTies, ErrorsInThemAreReported) {
    const auto with = [&](const std::string& more) { return figure + more; };
    const std::string nearly =
                          with("[cloth.flag]\nmaterial = \"m\"\nhold = [\"left\"]\nhold_on = \"collider.figur\"\n"),
                      body = with("[cloth.flag]\nmaterial = \"m\"\nhold = [\"left\"]\nhold_on = \"rope.r\"\n"),
                      nothing = with("[cloth.flag]\nmaterial = \"m\"\nhold_on = \"collider.figure\"\n"),
                      selector = with("[[joint]]\na = \"rope.r@end\"\nb = \"collider.figure@top\"\n"),
                      both = with("[[joint]]\na = \"collider.figure\"\nb = \"collider.figure\"\n"),
                      none = with("[[joint]]\na = \"cloth.cape@middle\"\nb = \"collider.figure\"\n"),
                      reach = with("[[joint]]\na = \"rope.r@end\"\nb = \"collider.figure\"\nreach_m = 1\n");
    expectMessages({
        {"nearly a collider", nearly.c_str(),
         "s.toml:15:11: error: there is no collider.figur\n"
         "  hold_on = \"collider.figur\"\n"
         "            ^ did you mean \"collider.figure\"?"},
        {"held on a body", body.c_str(),
         "s.toml:15:11: error: \"rope.r\" names no collider\n"
         "  hold_on = \"rope.r\"\n"
         "            ^ write collider.NAME"},
        {"nothing is held", nothing.c_str(),
         "s.toml:14:11: error: hold_on attaches the points of hold, and there is no hold\n"
         "  hold_on = \"collider.figure\"\n"
         "            ^ name the points, e.g. hold = [\"top\"]"},
        {"points of a collider", selector.c_str(),
         "s.toml:14:5: error: a collider has no points to choose from\n"
         "  b = \"collider.figure@top\"\n"
         "      ^ write collider.figure"},
        {"two colliders", both.c_str(),
         "s.toml:12:1: error: both sides of this joint are colliders\n"
         "  [[joint]]\n"
         "  ^ one of them has to be points of a body: KIND.NAME@SELECTOR"},
        {"no point", none.c_str(),
         "s.toml:13:5: error: cloth.cape has no points \"middle\"\n"
         "  a = \"cloth.cape@middle\"\n"
         "      ^ it has left, right, top, bottom, top-left, top-right, bottom-left, bottom-right, corners, edges, "
         "all"},
        {"a reach", reach.c_str(),
         "s.toml:15:1: error: reach_m does not go with a weld to a collider\n"
         "  reach_m = 1\n"
         "  ^ it belongs to a weld"},
    });
}

}  // namespace
}  // namespace taut::scene
