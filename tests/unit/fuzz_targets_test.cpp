// The targets of the fuzzer without it: every reader with its seeds, and with a few accidents that befall them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "fuzz/targets.h"

namespace taut::fuzz {
namespace {

// A number, a piece that is lost, doubled or moved, a byte.
void befall(Bytes& bytes, std::mt19937& random) {
    if (bytes.empty()) bytes.push_back('0');
    const std::size_t at = random() % bytes.size(),
                      length = random() % std::min<std::size_t>(bytes.size() - at, 40) + 1;
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at),
               end = begin + static_cast<std::ptrdiff_t>(length);
    const Bytes piece(begin, std::min(end, bytes.end()));
    switch (random() % 5) {
        case 0: bytes.erase(begin, std::min(end, bytes.end())); return;
        case 1: bytes.insert(begin, piece.begin(), piece.end()); return;
        case 2:
            std::copy(piece.begin(), piece.end(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(random() % (bytes.size() - piece.size() + 1)));
            return;
        case 3:
            std::fill(begin, std::min(begin + 4, bytes.end()),
                      static_cast<std::uint8_t>(random() % 2 == 0 ? 0xFF : '9'));
            return;
        default: *begin = static_cast<std::uint8_t>(random());
    }
}

std::vector<Bytes> filesIn(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Bytes> files;
    for (const std::filesystem::path& path : paths) {
        std::ifstream file(path, std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    return files;
}

TEST(FuzzTargets, ReadOrRefuseWhateverBefallsTheirSeeds) {
    const std::filesystem::path seeds =
        std::filesystem::path(testing::TempDir()) / ("fuzz_seeds_" + std::to_string(::getpid()));
    const std::string script = TAUT_SOURCE_DIR "/tests/fuzz/seeds.sh";
    ASSERT_EQ(std::system(("sh '" + script + "' '" TAUT_SOURCE_DIR "' '" + seeds.string() + "'").c_str()), 0);
    std::mt19937 random(5);
    for (const Target& target : targets()) {
        SCOPED_TRACE(target.name);
        std::vector<Bytes> files = filesIn(seeds / target.name);
        if (files.empty())
            files.push_back(changed(
                target, {}, [](Bytes&) {}, 20));  // the target makes them
        if (target.name == "play") continue;      // has tests of its own
        // Scenes and worlds take a hundred times as long as the rest, and have more accidents in tests of their own.
        const bool isSlow = std::string("overrides scene timeline world").find(target.name) != std::string::npos;
        const std::size_t rounds = isSlow ? 3 : 100;
        for (std::size_t i = 0; i < rounds; ++i) {
            Bytes bytes = files[i * files.size() / rounds];
            give(target, bytes);
            for (std::size_t accidents = 1 + random() % 3; accidents > 0; --accidents)
                bytes = changed(
                    target, bytes, [&](Bytes& all) { befall(all, random); }, static_cast<unsigned>(random()));
            give(target, bytes);
        }
    }
    std::filesystem::remove_all(seeds);
}

}  // namespace
}  // namespace taut::fuzz
