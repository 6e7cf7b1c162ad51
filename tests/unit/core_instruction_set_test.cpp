#include "taut/core/private/instruction_set.h"

#include <gtest/gtest.h>

#include <vector>

#include "taut/core/error.h"

namespace taut::core {
namespace {

TEST(InstructionSets, AWiderOneHasToGainATwentieth) {
    using enum InstructionSet;
    const auto fastest = [](double s, double a, double w) {
        return fastestOf(std::vector<InstructionSetTime>{{sse2, s}, {avx2, a}, {avx512, w}});
    };
    EXPECT_EQ(fastest(2.0, 1.0, 0.7), avx512);
    EXPECT_EQ(fastest(2.0, 1.0, 0.96), avx2);
    EXPECT_EQ(fastest(1.0, 0.96, 0.94), avx512);
    EXPECT_EQ(fastest(1.0, 1.2, 1.1), sse2);
    EXPECT_EQ(fastestOf(std::vector<InstructionSetTime>{{sse2, 1.0}}), sse2);
}

// The choice is the process's: the previous choice is put back.
TEST(InstructionSets, SayHowTheyWereChosen) {
    const InstructionSet before = instructionSet();
    chooseInstructionSet("sse2", "TAUT_SIMD");
    EXPECT_EQ(instructionSet(), InstructionSet::sse2);
    EXPECT_EQ(instructionSetReason(), "TAUT_SIMD");
    chooseInstructionSet("auto", "TAUT_SIMD");
    EXPECT_TRUE(isSupported(instructionSet()));
    EXPECT_TRUE(instructionSetReason().starts_with("trial: sse2 ")) << instructionSetReason();
    EXPECT_THROW(chooseInstructionSet("avx", "TAUT_SIMD"), Error);
    useInstructionSet(before);
}

}  // namespace
}  // namespace taut::core
