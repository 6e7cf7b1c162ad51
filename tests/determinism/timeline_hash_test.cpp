// Half a second of everything that a timeline can do gives the same state hash at every tick: for every number of
// threads, every instruction set and, through the recorded hashes, every compiler.
#include <gtest/gtest.h>

#include "support/timelines.h"
#include "taut/core/private/instruction_set.h"

namespace taut {
namespace {

std::vector<std::uint64_t> hashes(bool isDouble, int threads, core::InstructionSet set) {
    const core::InstructionSet before = core::instructionSet();
    core::useInstructionSet(set);
    world::World world(support::everythingHappens("leapfrog", isDouble), {.threads = threads});
    std::vector<std::uint64_t> chain{world.stateHash()};
    for (int i = 0; i < 30; ++i) {
        if (const auto divergence = world.advance()) ADD_FAILURE() << divergence->message;
        chain.push_back(world.stateHash());
    }
    core::useInstructionSet(before);
    return chain;
}

class TimelineHash : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SingleAndDouble, TimelineHash, testing::Bool());

TEST_P(TimelineHash, IsTheSameForOneTwoAndSevenThreads) {
    const auto one = hashes(GetParam(), 1, core::instructionSet());
    EXPECT_EQ(one, hashes(GetParam(), 2, core::instructionSet()));
    EXPECT_EQ(one, hashes(GetParam(), 7, core::instructionSet()));
}

TEST_P(TimelineHash, IsTheSameForEveryInstructionSet) {
    const auto sse2 = hashes(GetParam(), 2, core::InstructionSet::sse2);
    for (core::InstructionSet set : {core::InstructionSet::avx2, core::InstructionSet::avx512})
        if (core::isSupported(set)) EXPECT_EQ(sse2, hashes(GetParam(), 2, set)) << nameOf(set);
}

// Recorded with g++ 12. They change with the scene of tests/support/timelines.h, and with the bits of results (3: tears
// and yields at every substep; 6: one pressure for a cell of a block; 8: its inertia).
TEST_P(TimelineHash, IsAsRecorded) {
    EXPECT_EQ(hashes(GetParam(), 2, core::instructionSet()).back(),
              GetParam() ? 0x577372e8dba5e0a7ULL : 0x58d6b0762275091dULL);
}

}  // namespace
}  // namespace taut
