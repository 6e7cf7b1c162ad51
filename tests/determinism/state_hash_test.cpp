// The same scene gives the same state hash at every tick: for every number of threads, every instruction set, and —
// through the recorded hashes, with which both compilers' builds are compared — every compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "taut/core/private/instruction_set.h"
#include "taut/ode/method_table.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut {
namespace {

const std::filesystem::path source = TAUT_SOURCE_DIR;

// A scene's name may be followed by ":" and the method that takes the place of its own.
std::filesystem::path pathOf(const std::string& scene) {
    if (const std::size_t colon = scene.find(':'); colon != std::string::npos) return pathOf(scene.substr(0, colon));
    const std::filesystem::path own = source / "tests/determinism" / (scene + ".toml");
    if (std::filesystem::exists(own)) return own;
    return source / "assets/scenes" / (scene + ".toml");
}

std::vector<std::uint64_t> hashes(const std::string& scene, const std::string& precision, int ticks, int threads,
                                  core::InstructionSet set) {
    const core::InstructionSet before = core::instructionSet();
    core::useInstructionSet(set);
    scene::LoadOptions options;
    options.overrides = {"solver.precision=\"" + precision + "\""};
    options.assetFolders = {source / "assets"};
    if (const std::size_t colon = scene.find(':'); colon != std::string::npos)
        options.overrides.push_back("solver.integrator=\"" + scene.substr(colon + 1) + "\"");
    world::World world(scene::loadScene(pathOf(scene), options).spec, {.threads = threads});
    std::vector<std::uint64_t> chain{world.stateHash()};
    for (int i = 0; i < ticks; ++i) {
        if (const auto divergence = world.advance()) ADD_FAILURE() << divergence->message;
        chain.push_back(world.stateHash());
    }
    core::useInstructionSet(before);
    return chain;
}

constexpr int ticks = 24;  // the cloths have landed, the sweeper has struck, the joint has swung

class EveryPrecision : public testing::TestWithParam<const char*> {};

TEST_P(EveryPrecision, HashesChangeWhenAnythingDoes) {
    scene::LoadOptions options;
    options.overrides = {"solver.precision=\"" + std::string(GetParam()) + "\"", "rope.line.mass_kg=1.0001"};
    world::World world(scene::loadScene(pathOf("everything"), options).spec, {.threads = 2});
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(world.advance());
    EXPECT_NE(world.stateHash(), hashes("everything", GetParam(), 3, 2, core::instructionSet()).back());
}

// All kinds of springs and forces, a contact, a joint: every method, on any hardware, and each its own motion.
TEST_P(EveryPrecision, HashesOfEveryMethodAreTheSameForThreadsAndInstructionSets) {
    std::map<std::uint64_t, std::string_view> seen;
    for (const ode::MethodInfo& method : ode::methods()) {
        SCOPED_TRACE(method.name);
        const std::string scene = "every_method:" + std::string(method.name);
        const auto one = hashes(scene, GetParam(), 12, 1, core::instructionSet());
        EXPECT_EQ(one, hashes(scene, GetParam(), 12, 2, core::instructionSet()));
        EXPECT_EQ(one, hashes(scene, GetParam(), 12, 7, core::instructionSet()));
        EXPECT_EQ(one, hashes(scene, GetParam(), 12, 2, core::InstructionSet::sse2));
        EXPECT_TRUE(seen.emplace(one.back(), method.name).second) << "the same as " << seen[one.back()];
    }
}

// Pins, rods and springs that break, are released and cut, and a step that follows the pull of rods; sheets and ropes
// that bend, in several tasks and with scattered points; meshes that bend away from a curve; threads that rub; a
// figure; seams that close and tear; solids that are round; bodies of all kinds that a collider carries.
TEST_P(EveryPrecision, HashesOfJointsAndBendingAreTheSameForThreadsAndInstructionSets) {
    const auto orDefault = [](core::InstructionSet wanted) {
        return core::isSupported(wanted) ? wanted : core::instructionSet();
    };
    for (const char* scene : {"joints", "bending", "bent-mesh", "rubbing", "figures", "seams", "solids", "carried"}) {
        const auto one = hashes(scene, GetParam(), 40, 1, core::InstructionSet::sse2);
        EXPECT_EQ(one, hashes(scene, GetParam(), 40, 2, orDefault(core::InstructionSet::avx2))) << scene;
        EXPECT_EQ(one, hashes(scene, GetParam(), 40, 7, orDefault(core::InstructionSet::avx512))) << scene;
    }
}

INSTANTIATE_TEST_SUITE_P(StateHash, EveryPrecision, testing::Values("single", "double"));

// scene precision ticks hash; a line that begins with # says why the hashes below it changed.
struct Recorded {
    std::string scene, precision;
    int ticks = 0;
    std::uint64_t hash = 0;
};

std::vector<Recorded> recorded() {
    std::ifstream file(source / "tests/determinism/hashes.txt");
    std::vector<Recorded> all;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        Recorded r;
        words >> r.scene >> r.precision >> r.ticks >> std::hex >> r.hash;
        EXPECT_FALSE(words.fail()) << line;
        all.push_back(r);
    }
    return all;
}

void expectRecorded(const Recorded& r, std::uint64_t hash) {
    char line[128];
    std::snprintf(line, sizeof line, "%s %s %d %016" PRIx64, r.scene.c_str(), r.precision.c_str(), r.ticks, hash);
    EXPECT_EQ(hash, r.hash) << "computed: " << line
                            << "\nWhere the change of state is meant, put this line into "
                               "tests/determinism/hashes.txt, with a line above it that says why.";
}

// Threads and instruction sets vary together: whichever of them changes a bit, the hashes differ.
TEST_P(EveryPrecision, HashesAreTheSameForThreadsAndInstructionSetsAndAsRecorded) {
    const auto orDefault = [](core::InstructionSet wanted) {
        return core::isSupported(wanted) ? wanted : core::instructionSet();
    };
    const auto one = hashes("everything", GetParam(), ticks, 1, core::InstructionSet::sse2);
    EXPECT_EQ(one, hashes("everything", GetParam(), ticks, 2, orDefault(core::InstructionSet::avx2)));
    EXPECT_EQ(one, hashes("everything", GetParam(), ticks, 7, orDefault(core::InstructionSet::avx512)));
    const std::vector<Recorded> all = recorded();
    const auto of = std::find_if(all.begin(), all.end(), [](const Recorded& r) {
        return r.scene == "everything" && r.precision == GetParam() && r.ticks == ticks;
    });
    ASSERT_NE(of, all.end());
    expectRecorded(*of, one.back());
}

TEST(RecordedHash, IsWhatThisBuildComputes) {
    const std::vector<Recorded> all = recorded();
    ASSERT_GE(all.size(), 9U);
    for (const Recorded& r : all) {
        if (r.scene == "everything") continue;  // compared above, where it is computed anyway
        expectRecorded(r, hashes(r.scene, r.precision, r.ticks, 2, core::instructionSet()).back());
    }
}

TEST(RecordedHash, CoversEveryShippedScene) {
    std::map<std::string, int> seen;
    for (const Recorded& r : recorded()) ++seen[r.scene];
    for (const auto& entry : std::filesystem::directory_iterator(source / "assets/scenes"))
        if (entry.path().extension() == ".toml") EXPECT_TRUE(seen.contains(entry.path().stem())) << entry.path();
}

}  // namespace
}  // namespace taut
