// Tapes: their content, the first difference of two, and refused files. The differences are made by hand or by a
// change of the scene whose effect is known: points that a spring's force has not reached yet agree.
#include "taut/regression/tape.h"

#include <gtest/gtest.h>

#include <cstring>

#include "regression_support.h"
#include "taut/pipeline/sealed_file.h"
#include "taut/regression/tape_compare.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::regression {
namespace {

using test::has;
using test::TemporaryFolder;

Tape record(const std::string& text, int ticks, bool withPoints = true) {
    world::World world(scene::loadSceneText(text, "s.toml", {}).spec, {.threads = 1});
    Tape tape = blankTape();
    addTick(tape, world, withPoints);
    for (int i = 0; i < ticks; ++i) {
        EXPECT_FALSE(world.advance());
        addTick(tape, world, withPoints);
    }
    return tape;
}

TEST(Tape, ComesBackFromItsFileAsItWas) {
    const TemporaryFolder folder;
    Tape tape = record(test::springText(), 6);
    tape.origin.scene = "s.toml";
    tape.origin.text = test::springText();
    tape.origin.overrides = {"run.fps=20"};
    writeTape(folder / "a.tape", tape);
    const Tape back = readTape(folder / "a.tape");
    EXPECT_FALSE(firstDifference(tape, back));
    EXPECT_EQ(back.ticks(), 6);
    EXPECT_EQ(back.chain, tape.chain);
    EXPECT_EQ(back.points, tape.points);
    EXPECT_EQ(back.origin.text, tape.origin.text);
    EXPECT_EQ(back.origin.overrides, tape.origin.overrides);
    EXPECT_EQ(back.casts.front().names, (std::vector<std::string>{"net.spring", "rope.line"}));
    EXPECT_EQ(back.casts.front().points, (std::vector<int>{2, 5}));
}

TEST(Tape, NamesTickBodyAndPointThatDifferFirst) {
    const Tape right = record(test::springText(), 6);
    Tape wrong = right;
    // Point 3 of the rope, and from then on the chain.
    for (std::size_t tick = 4; tick <= 6; ++tick) wrong.chain[tick] ^= 1U;
    wrong.bodies[wrong.bodyAt[4] + 1] ^= 1U;
    wrong.points[wrong.pointAt[4] + 2 + 3] ^= 1U;
    const auto difference = firstDifference(right, wrong);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->fault, TapeFault::state);
    EXPECT_EQ(difference->tick, 4);
    EXPECT_EQ(difference->frame, 2);  // frame 1 shows tick 3, frame 2 tick 6
    EXPECT_DOUBLE_EQ(difference->time, 4.0 / 60.0);
    EXPECT_EQ(difference->body, "rope.line");
    EXPECT_EQ(difference->point, 3);
    EXPECT_EQ(difference->points, 1);
    EXPECT_EQ(describe(*difference), "tick 4 (0.06667 s, frame 2): rope.line differs first, at point 3");
}

// The bob is the only point whose force the stiffness enters; the nail is held and the rope hangs apart.
TEST(Tape, TellsWhichPointASofterSpringMovesOtherwise) {
    // Stretched at the start, so that the stiffness matters at once.
    const std::string pulled = ", rest_length_m = 0.8 } ]";
    std::string stiff = test::springText("100.0"), soft = test::springText("99.0");
    for (std::string* text : {&stiff, &soft}) text->replace(text->find(" } ]\n[rope"), 4, pulled);
    const auto difference = firstDifference(record(stiff, 4), record(soft, 4));
    ASSERT_TRUE(difference);
    // Leap-frog keeps the velocity of half a step later, so the force is felt in the stored state of the start.
    EXPECT_EQ(difference->tick, 0);
    EXPECT_EQ(difference->body, "net.spring");
    EXPECT_EQ(difference->bodies, 1);
    EXPECT_EQ(difference->point, 1);
}

TEST(Tape, WithoutPointsItNamesTheBody) {
    const Tape right = record(test::springText(), 4, false);
    Tape wrong = right;
    wrong.chain[2] ^= 1U;
    wrong.bodies[wrong.bodyAt[2]] ^= 1U;
    const auto difference = firstDifference(right, wrong);
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->body, "net.spring");
    EXPECT_EQ(difference->point, -1);
    EXPECT_TRUE(right.points.empty());
}

TEST(Tape, OtherBodiesOtherRatesAndOtherLengthsAreToldApart) {
    const Tape right = record(test::springText(), 4);
    std::string without = test::springText();
    without.replace(without.find("[rope.line]"), 11, "[rope.lane]");
    const auto cast = firstDifference(right, record(without, 4));
    ASSERT_TRUE(cast);
    EXPECT_EQ(cast->fault, TapeFault::cast);
    EXPECT_TRUE(cast->body == "rope.line" || cast->body == "rope.lane");

    std::string faster = test::springText();
    faster.replace(faster.find("fps = 20"), 8, "fps = 50");
    EXPECT_EQ(firstDifference(right, record(faster, 4))->fault, TapeFault::rates);

    const auto length = firstDifference(right, record(test::springText(), 3));
    ASSERT_TRUE(length);
    EXPECT_EQ(length->fault, TapeFault::length);
    EXPECT_EQ(length->tick, 4);

    Tape other = right;
    other.chain[3] ^= 1U;
    EXPECT_EQ(firstDifference(right, other)->fault, TapeFault::chain);
}

TEST(Tape, OfTheSameRunIsTheSame) {
    EXPECT_FALSE(firstDifference(record(test::springText(), 6), record(test::springText(), 6)));
}

TEST(Tape, DamagedForeignAndFutureOnesAreRefused) {
    const TemporaryFolder folder;
    writeTape(folder / "a.tape", record(test::springText(), 3));
    const std::string whole = test::contentOf(folder / "a.tape");
    const auto said = [&](const std::string& content) {
        test::writeText(folder / "b.tape", content);
        return test::messageOf(core::ErrorKind::badContent, [&] { readTape(folder / "b.tape"); });
    };
    EXPECT_TRUE(has(said("no tape at all"), "b.tape: this is no tape of taut"));
    EXPECT_TRUE(has(said(""), "this is no tape"));
    std::string future = whole;
    future[8] = 9;  // the version follows eight characters
    EXPECT_TRUE(has(said(future), "has format 9")) << said(future);
    for (std::size_t at : {std::size_t{12}, whole.size() / 2, whole.size() - 1}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_TRUE(has(said(damaged), "b.tape: ")) << at;
    }
    for (std::size_t length : {std::size_t{10}, whole.size() / 2, whole.size() - 1})
        EXPECT_FALSE(said(whole.substr(0, length)).empty()) << length;
    test::messageOf(core::ErrorKind::inputOutput, [&] { readTape(folder / "none.tape"); });
}

// The number is the last of the content; formats 1 and 2 end before it.
TEST(Tape, KeepsItsBitsAndWithoutANumberIsOfBitsOne) {
    const TemporaryFolder folder;
    Tape tape = record(test::springText(), 3);
    EXPECT_EQ(tape.origin.bits, world::resultBits);
    tape.origin.bits = 77;
    writeTape(folder / "a.tape", tape);
    EXPECT_EQ(readTape(folder / "a.tape").origin.bits, 77);
    std::vector<std::byte> content = pipeline::readSealed(folder / "a.tape", {"tauttape", 3, "tape"});
    for (const std::int32_t none : {0, -1, world::mostBits + 1}) {
        std::memcpy(content.data() + content.size() - sizeof none, &none, sizeof none);
        pipeline::writeSealed(folder / "b.tape", {"tauttape", 3, "tape"}, content);
        EXPECT_TRUE(
            has(test::messageOf(core::ErrorKind::badContent, [&] { readTape(folder / "b.tape"); }), "b.tape: "));
    }
    content.resize(content.size() - sizeof(std::int32_t));
    pipeline::writeSealed(folder / "b.tape", {"tauttape", 2, "tape"}, content);
    EXPECT_EQ(readTape(folder / "b.tape").origin.bits, 1);
}

// Whole by its checksum and yet nonsense inside: counts that do not fit each other.
TEST(Tape, ContentThatContradictsItselfIsRefused) {
    const TemporaryFolder folder;
    Tape tape = record(test::springText(), 3);
    tape.bodies.pop_back();
    writeTape(folder / "a.tape", tape);
    EXPECT_TRUE(has(test::messageOf(core::ErrorKind::badContent, [&] { readTape(folder / "a.tape"); }), "a.tape: "));
    const std::vector<std::byte> nothing;
    pipeline::writeSealed(folder / "b.tape", {"tauttape", 1, "tape"}, nothing);
    EXPECT_TRUE(has(test::messageOf(core::ErrorKind::badContent, [&] { readTape(folder / "b.tape"); }), "b.tape: "));
}

}  // namespace
}  // namespace taut::regression
