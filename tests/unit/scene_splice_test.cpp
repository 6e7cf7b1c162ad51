// Changed values are written where they stand; every other byte of the file stays.
#include "taut/scene/private/splice.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "taut/core/error.h"

namespace taut::scene {
namespace {

std::string splicedOne(const std::string& text, const std::string& key, const std::string& value) {
    const std::vector<Change> changes{{key, value}};
    return spliced(text, changes);
}

// The message of the error, or nothing.
std::string refusal(const std::string& text, const std::string& key, const std::string& value) {
    try {
        (void)splicedOne(text, key, value);
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

TEST(Splice, ReplacesAValueAndNothingElse) {
    EXPECT_EQ(splicedOne("a = 1  # one\n\n[b]\nc   =\t2.50   # two\nd = 3\n", "b.c", "7"),
              "a = 1  # one\n\n[b]\nc   =\t7   # two\nd = 3\n");
}

TEST(Splice, WithoutChangesKeepsEveryByte) {
    const std::string text = "# \xC3\xA4\r\n[a]\r\n  b = [ 1,\t2 ] # x\r\n\r\n";
    EXPECT_EQ(spliced(text, {}), text);
}

TEST(Splice, OfAListThatKeepsItsLengthReplacesTheElementsThatDiffer) {
    const std::string text = "[a]\ncells = [  # across\n  36,\n  24,  # ] down\n]  # end\nb = 1\n";
    EXPECT_EQ(splicedOne(text, "a.cells", "[12, 8]"),
              "[a]\ncells = [  # across\n  12,\n  8,  # ] down\n]  # end\nb = 1\n");
    EXPECT_EQ(splicedOne(text, "a.cells", "[36, 8]"),
              "[a]\ncells = [  # across\n  36,\n  8,  # ] down\n]  # end\nb = 1\n");
    EXPECT_EQ(splicedOne(text, "a.cells", "[36, 24]"), text);
    EXPECT_EQ(splicedOne("x = [ [1 , 2], # one\n [3, 4] ]\n", "x", "[[1, 5], [3, 6]]"),
              "x = [ [1 , 5], # one\n [3, 6] ]\n");
}

TEST(Splice, ReplacesAListOfAnotherLengthWholeWithItsComments) {
    EXPECT_EQ(splicedOne("[a]\nx = [  # across\n  36,\n  24,  # ] down\n]  # end\nb = 1\n", "a.x", "[12, 8, 4]"),
              "[a]\nx = [12, 8, 4]  # end\nb = 1\n");
    EXPECT_EQ(splicedOne("x = [1, [2, 3]]  # x\n", "x", "[1, [4]]"), "x = [1, [4]]  # x\n");
}

TEST(Splice, ReplacesOneElementOfAList) {
    EXPECT_EQ(splicedOne("x = [1, [2, 3], 4]\n", "x.1.0", "9"), "x = [1, [9, 3], 4]\n");
}

TEST(Splice, FindsValuesInsideBraces) {
    EXPECT_EQ(splicedOne("[w]\ngust = { amplitude = 2.5, period_s = 1.7 }  # {\n", "w.gust.amplitude", "0.0"),
              "[w]\ngust = { amplitude = 0.0, period_s = 1.7 }  # {\n");
}

TEST(Splice, FindsDottedAndQuotedKeys) {
    EXPECT_EQ(splicedOne("[w]\ngust . \"amplitude\" = 2.5\n", "w.gust.amplitude", "0.0"),
              "[w]\ngust . \"amplitude\" = 0.0\n");
    EXPECT_EQ(splicedOne("[ w . 'a' ]\nb = 1\n", "w.a.b", "2"), "[ w . 'a' ]\nb = 2\n");
}

TEST(Splice, FindsTheElementOfAListOfTables) {
    const std::string text = "[[joint]]\na = 1\n[[joint]]\na = 2\n[joint.in]\nb = 3\n";
    EXPECT_EQ(splicedOne(text, "joint.1.a", "5"), "[[joint]]\na = 1\n[[joint]]\na = 5\n[joint.in]\nb = 3\n");
    EXPECT_EQ(splicedOne(text, "joint.1.in.b", "6"), "[[joint]]\na = 1\n[[joint]]\na = 2\n[joint.in]\nb = 6\n");
    EXPECT_EQ(splicedOne(text, "joint.0.c", "7"), "[[joint]]\na = 1\nc = 7\n[[joint]]\na = 2\n[joint.in]\nb = 3\n");
}

TEST(Splice, IsNotMisledByStringsAndComments) {
    const std::string before = "t = \"\"\"\n[a]\nb = 1\n\"\"\"\"\n# [a]\n# b = 2\nu = 'b = \"'\n[a]  # b = 3\n";
    EXPECT_EQ(splicedOne(before + "b = \"x # \\\" ]\"  # y\n", "a.b", "\"z\""), before + "b = \"z\"  # y\n");
}

TEST(Splice, KeepsLettersBeyondAsciiAndTheByteOrderMark) {
    EXPECT_EQ(splicedOne("\xEF\xBB\xBFtitle = \"\xC3\xA4\xE2\x82\xAC\"  # \xF0\x9F\x8E\x88\nb = 1\n", "b", "2"),
              "\xEF\xBB\xBFtitle = \"\xC3\xA4\xE2\x82\xAC\"  # \xF0\x9F\x8E\x88\nb = 2\n");
}

TEST(Splice, KeepsLineEndsOfTheOtherKind) {
    EXPECT_EQ(splicedOne("[a]\r\nb = 1\r\nc = 2\r\n", "a.b", "3"), "[a]\r\nb = 3\r\nc = 2\r\n");
    EXPECT_EQ(splicedOne("[a]\r\nb = 1\r\n\r\n[c]\r\n", "a.d", "3"), "[a]\r\nb = 1\r\nd = 3\r\n\r\n[c]\r\n");
    EXPECT_EQ(splicedOne("[a]\r\nb = 1\r\n", "c.d", "3"), "[a]\r\nb = 1\r\n\r\n[c]\r\nd = 3\r\n");
}

TEST(Splice, AddsAMissingKeyBehindTheLastOfItsTable) {
    EXPECT_EQ(splicedOne("[a]\n  b = [\n    1]  # one\n\n# about c\n[c]\nd = 2\n", "a.e", "3"),
              "[a]\n  b = [\n    1]  # one\n  e = 3\n\n# about c\n[c]\nd = 2\n");
    EXPECT_EQ(splicedOne("[a]  # empty\n[b]\n", "a.c", "1"), "[a]  # empty\nc = 1\n[b]\n");
    EXPECT_EQ(splicedOne("[a]\nb = 1", "a.c", "2"), "[a]\nb = 1\nc = 2");
}

TEST(Splice, AddsAMissingKeyInTheWayItsTableIsWritten) {
    EXPECT_EQ(splicedOne("[w]\ngust = { a = 1 }\n", "w.gust.b", "2"), "[w]\ngust = { a = 1, b = 2 }\n");
    EXPECT_EQ(splicedOne("[w]\ngust = {}\n", "w.gust.b", "2"), "[w]\ngust = { b = 2 }\n");
    EXPECT_EQ(splicedOne("[w]\ngust.a = 1  # one\nv = 3\n", "w.gust.b", "2"),
              "[w]\ngust.a = 1  # one\ngust.b = 2\nv = 3\n");
    EXPECT_EQ(splicedOne("[c.f]\nx = 1\n", "c.f.solver.dt", "0.1"), "[c.f]\nx = 1\nsolver.dt = 0.1\n");
}

TEST(Splice, AddsAMissingTableAtTheEnd) {
    EXPECT_EQ(splicedOne("a = 1", "solver.dt", "0.1"), "a = 1\n\n[solver]\ndt = 0.1\n");
    const std::vector<Change> both{{"solver.dt", "0.1"}, {"solver.safety", "0.5"}};
    EXPECT_EQ(spliced("a = 1\n", both), "a = 1\n\n[solver]\ndt = 0.1\nsafety = 0.5\n");
}

TEST(Splice, AddsAKeyAtTheTopBeforeTheFirstTable) {
    EXPECT_EQ(splicedOne("a = 1  # x\n\n[b]\n", "c", "2"), "a = 1  # x\nc = 2\n\n[b]\n");
    EXPECT_EQ(splicedOne("[b]\nd = 1\n", "c", "2"), "c = 2\n[b]\nd = 1\n");
}

TEST(Splice, RefusesWhatCannotBeWritten) {
    EXPECT_NE(refusal("a = \n", "a", "1"), "");
    EXPECT_NE(refusal("a = 1\n", "a", "1 2").find("cannot be written"), std::string::npos);
    EXPECT_NE(refusal("a = 1\n", "a", "1\nb = 2"), "") << "one value, not a line more";
    EXPECT_NE(refusal("a = 1\n", "a.b", "2").find("plain value"), std::string::npos);
    EXPECT_NE(refusal("a = [1]\n", "a.1", "2").find("no such element"), std::string::npos);
}

}  // namespace
}  // namespace taut::scene
