// Every row: a faulty check and the exact message with file, line, column, caret and remedy.
#include "unit/scene_support.h"

namespace taut::scene {
namespace {

TEST(SceneErrors, ClaimsThatCannotBeReadAreReported) {
    expectMessages({
        {"an empty claim",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"\"\n",
         "s.toml:5:9: error: this claim is empty\n"
         "  that = \"\"\n"
         "          ^ write e.g. max_strain(cloth.*) < 0.1"},
        {"half a claim",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"max_strain(rope.r)\"\n",
         "s.toml:5:27: error: a claim compares two things\n"
         "  that = \"max_strain(rope.r)\"\n"
         "                            ^ add e.g. < 0.1"},
        {"a claim without a bound",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"max_strain(rope.r) <\"\n",
         "s.toml:5:29: error: the end stands where a number or a function is expected\n"
         "  that = \"max_strain(rope.r) <\"\n"
         "                              ^"},
        {"an assignment",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"max_strain(rope.r) = 1\"\n",
         "s.toml:5:28: error: a claim compares with ==, not =\n"
         "  that = \"max_strain(rope.r) = 1\"\n"
         "                             ^"},
        {"an unknown function",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"0.1 > max_stain(rope.r)\"\n",
         "s.toml:5:15: error: there is no function \"max_stain\"\n"
         "  that = \"0.1 > max_stain(rope.r)\"\n"
         "                ^ did you mean \"max_strain\"?"},
        {"a function that resembles none",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"zzz(rope.r) < 1\"\n",
         "s.toml:5:9: error: there is no function \"zzz\"\n"
         "  that = \"zzz(rope.r) < 1\"\n"
         "          ^ see taut schema --manual"},
        {"no axis",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"shadow(rope.r, up) < 1\"\n",
         "s.toml:5:24: error: an axis is x, y or z\n"
         "  that = \"shadow(rope.r, up) < 1\"\n"
         "                         ^ write shadow(BODIES, AXIS)"},
        {"too few arguments",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"distance(rope.r@end) < 1\"\n",
         "s.toml:5:9: error: distance takes 2 arguments\n"
         "  that = \"distance(rope.r@end) < 1\"\n"
         "          ^ write distance(PLACE, PLACE)"},
        {"too many arguments",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"1 < speed(rope.r, rope.r)\"\n",
         "s.toml:5:13: error: speed takes 1 argument\n"
         "  that = \"1 < speed(rope.r, rope.r)\"\n"
         "              ^ write speed(POINTS)"},
        {"no arguments",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed < 1\"\n",
         "s.toml:5:9: error: speed needs its arguments\n"
         "  that = \"speed < 1\"\n"
         "          ^ write speed(POINTS)"},
        {"a missing target",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed() < 1\"\n",
         "s.toml:5:9: error: speed takes 1 argument\n"
         "  that = \"speed() < 1\"\n"
         "          ^ write speed(POINTS)"},
        {"a bracket that stays open",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"2 * (speed(rope.r) + 1 < 3\"\n",
         "s.toml:5:32: error: \")\" is missing behind this\n"
         "  that = \"2 * (speed(rope.r) + 1 < 3\"\n"
         "                                 ^"},
        {"an argument of a function of none",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"time(rope.r) < 1\"\n",
         "s.toml:5:9: error: time takes nothing\n"
         "  that = \"time(rope.r) < 1\"\n"
         "          ^ write time"},
        {"a vector without a component",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"position(rope.r@end) < 1\"\n",
         "s.toml:5:9: error: this has three components\n"
         "  that = \"position(rope.r@end) < 1\"\n"
         "          ^ add .x, .y or .z, or take length(…)"},
        {"a component of a number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r).x < 1\"\n",
         "s.toml:5:22: error: only a vector has components\n"
         "  that = \"speed(rope.r).x < 1\"\n"
         "                       ^"},
        {"an unknown component",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"position(rope.r).w < 1\"\n",
         "s.toml:5:25: error: behind the point stands x, y or z\n"
         "  that = \"position(rope.r).w < 1\"\n"
         "                          ^"},
        {"a number plus a vector",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"position(rope.r).x + momentum(rope.r) < 1\"\n",
         "s.toml:5:28: error: a number and a vector cannot be added or subtracted\n"
         "  that = \"position(rope.r).x + momentum(rope.r) < 1\"\n"
         "                             ^"},
        {"a product of vectors",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"length(momentum(rope.r) * momentum(rope.r)) < 1\"\n",
         "s.toml:5:33: error: two vectors cannot be multiplied\n"
         "  that = \"length(momentum(rope.r) * momentum(rope.r)) < 1\"\n"
         "                                  ^"},
        {"a unit behind a number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 3 m\"\n",
         "s.toml:5:27: error: \"m\" stands where a comparison is expected\n"
         "  that = \"speed(rope.r) < 3 m\"\n"
         "                            ^ use < <= > >= == or !="},
        {"a unit at a number",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 3m\"\n",
         "s.toml:5:26: error: a number has no unit behind it\n"
         "  that = \"speed(rope.r) < 3m\"\n"
         "                           ^ values are in SI units, see taut schema --manual"},
        {"a chain that turns back",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"1 < speed(rope.r) > 2\"\n",
         "s.toml:5:27: error: a chain of comparisons must go one way, as in 0.1 < x < 0.2\n"
         "  that = \"1 < speed(rope.r) > 2\"\n"
         "                            ^"},
        {"a claim about nothing",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"1 < 2\"\n",
         "s.toml:5:9: error: this claim says nothing about the scene\n"
         "  that = \"1 < 2\"\n"
         "          ^"},
        {"a place with two parts",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"distance(rope.r, [0, 1]) < 1\"\n",
         "s.toml:5:31: error: \",\" is missing between the three components\n"
         "  that = \"distance(rope.r, [0, 1]) < 1\"\n"
         "                                ^"},
        {"a body without a kind",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(r) < 1\"\n",
         "s.toml:5:15: error: \"r\" is no target\n"
         "  that = \"speed(r) < 1\"\n"
         "                ^ write KIND.NAME, e.g. cloth.flag"},
        {"a sign that means nothing",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 1 & 2\"\n",
         "s.toml:5:27: error: \"&\" stands where a comparison is expected\n"
         "  that = \"speed(rope.r) < 1 & 2\"\n"
         "                            ^ use < <= > >= == or !="},
        {"an escape before the fault",
         "[[check]]\n"
         "that = \"\\u0074ime < 1 $\"\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:23: error: \"$\" stands where a comparison is expected\n"
         "  that = \"\\u0074ime < 1 $\"\n"
         "                        ^ use < <= > >= == or !="},
        {"a claim between three quotes",
         "[[check]]\n"
         "that = '''time < 1 $'''\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:20: error: \"$\" stands where a comparison is expected\n"
         "  that = '''time < 1 $'''\n"
         "                     ^ use < <= > >= == or !="},
        {"a claim behind letters of two bytes",
         "[[check]]\n"
         "that = \"time < 1 é\"\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:3:18: error: \"é\" stands where a comparison is expected\n"
         "  that = \"time < 1 é\"\n"
         "                   ^ use < <= > >= == or !="},
    });
}

TEST(SceneErrors, ClaimsAboutWhatIsNotThereAreReported) {
    expectMessages({
        {"an unknown body",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"time > 3 * speed(rope.rr)\"\n",
         "s.toml:5:26: error: there is no rope.rr\n"
         "  that = \"time > 3 * speed(rope.rr)\"\n"
         "                           ^ did you mean \"rope.r\"?"},
        {"an unknown selector",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r@ent) < 1\"\n",
         "s.toml:5:15: error: rope.r has no points \"ent\"\n"
         "  that = \"speed(rope.r@ent) < 1\"\n"
         "                ^ did you mean \"end\"?"},
        {"points of a function of bodies",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"max_strain(rope.r@end) < 1\"\n",
         "s.toml:5:20: error: \"rope.r@end\" names points, not a body\n"
         "  that = \"max_strain(rope.r@end) < 1\"\n"
         "                     ^ write rope.r"},
        {"a second target",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"distance(rope.r@end, cloth.c@left) < 1\"\n",
         "s.toml:5:30: error: there is no cloth.c\n"
         "  that = \"distance(rope.r@end, cloth.c@left) < 1\"\n"
         "                               ^"},
        {"what is between a body and itself",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"gap(rope.r, rope.*) > 0.01\"\n",
         "s.toml:5:21: error: rope.r and rope.* are the same body, with nothing in between\n"
         "  that = \"gap(rope.r, rope.*) > 0.01\"\n"
         "                      ^ name another body"},
        {"what is between bodies before the spawn of one",
         "at = [{ t = 2, do = \"spawn\", target = \"rope.r\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[rope.q]\n"
         "ends = [[0, 1, 0], [1, 1, 0]]\n"
         "[[check]]\n"
         "that = \"gap(rope.q, rope.r) > 0.01\"\n",
         "s.toml:8:21: error: rope.r is not there at 0 s: it is spawned at 2 s\n"
         "  that = \"gap(rope.q, rope.r) > 0.01\"\n"
         "                      ^ give the check a later from"},
        {"a body before its spawn",
         "at = [{ t = 2, do = \"spawn\", target = \"rope.r\" }]\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"height(rope.r) < 1\"\n"
         "from = 1.5\n",
         "s.toml:6:16: error: rope.r is not there at 1.5 s: it is spawned at 2 s\n"
         "  that = \"height(rope.r) < 1\"\n"
         "                 ^ give the check a later from"},
        {"a moment after the end",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 1\"\n"
         "at = 5\n",
         "s.toml:6:6: error: 5 s is past the end: the last frame shows 4.98333 s\n"
         "  at = 5\n"
         "       ^ set seconds in [run]"},
        {"a span after the end",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 1\"\n"
         "from = 1\n"
         "to = 6\n",
         "s.toml:7:6: error: 6 s is past the end: the last frame shows 4.98333 s\n"
         "  to = 6\n"
         "       ^ set seconds in [run]"},
        {"a span that ends before it begins",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 1\"\n"
         "from = 2\n"
         "to = 1\n",
         "s.toml:7:6: error: to must come after from\n"
         "  to = 1\n"
         "       ^"},
        {"a moment and a span",
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n"
         "[[check]]\n"
         "that = \"speed(rope.r) < 1\"\n"
         "at = 2\n"
         "to = 3\n",
         "s.toml:7:1: error: to does not go with a check at a moment\n"
         "  to = 3\n"
         "  ^ it belongs to a check of a span"},
        {"a check without a claim",
         "[[check]]\n"
         "at = 1\n"
         "[rope.r]\n"
         "ends = [[0, 0, 0], [1, 0, 0]]\n",
         "s.toml:2:1: error: [[check]] needs that\n"
         "  [[check]]\n"
         "  ^ that is a text: The claim, e.g. \"max_strain(cloth.*) < 0.1\"; it must hold all the time unless a moment "
         "or a span is given"},
    });
}

TEST(SceneWarnings, ClaimsThatCountWhatNeverHappensAreDoubted) {
    const AssetFolder folder;
    const auto warningsOf = [&](const std::string& touch, const std::string& claim) {
        std::vector<std::string> warnings = folder
                                                .load(
                                                    "schema = 1\n"
                                                    "[rope.r]\n"
                                                    "ends = [[0, 0, 0], [1, 0, 0]]\n"
                                                    "[rope.touching]\n"
                                                    "ends = [[0, 1, 0], [1, 1, 0]]\n" +
                                                    touch +
                                                    "[[check]]\n"
                                                    "that = \"" +
                                                    claim + "\"\n")
                                                .warnings;
        for (std::string& warning : warnings) warning = folder.withoutFolder(warning);
        return warnings;
    };
    using Texts = std::vector<std::string>;
    const std::string touch = "touch = \"others\"\n";
    EXPECT_EQ(warningsOf(touch, "1 > 2 * crossings(rope.r)"),
              (Texts{"s.toml:8:27: warning: rope.r touches nothing: crossings is always 0\n"
                     "  that = \"1 > 2 * crossings(rope.r)\"\n"
                     "                            ^ give it touch = \"others\" or \"all\""}));
    EXPECT_EQ(warningsOf("", "body_contacts() < 1"),
              (Texts{"s.toml:7:9: warning: no body touches anything: body_contacts is always 0\n"
                     "  that = \"body_contacts() < 1\"\n"
                     "          ^ give it touch = \"others\" or \"all\""}));
    EXPECT_EQ(warningsOf(touch, "touching(rope.touching, rope.r) < 1"),
              (Texts{"s.toml:8:33: warning: rope.r touches nothing: however near they are, they go through each other\n"
                     "  that = \"touching(rope.touching, rope.r) < 1\"\n"
                     "                                  ^ give it touch = \"others\" or \"all\""}));
    EXPECT_EQ(warningsOf("", "face_penetration(rope.*) < 1"),
              (Texts{"s.toml:7:26: warning: rope.* meets no corners or edges of colliders: face_penetration is always "
                     "0\n"
                     "  that = \"face_penetration(rope.*) < 1\"\n"
                     "                           ^ give it collide = \"faces\", or touch"}));
    EXPECT_EQ(warningsOf("collide = \"faces\"\n", "face_penetration() < 1"), Texts());
    EXPECT_EQ(warningsOf(touch, "crossings(rope.*) + crossings() + gap(rope.r, rope.touching) < 1"), Texts());
}

}  // namespace
}  // namespace taut::scene
