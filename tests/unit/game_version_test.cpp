// Which build it is: the version, the commit and the bits, and the changelog that says the same.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "image_support.h"
#include "program_support.h"
#include "taut/world/result_bits.h"

namespace taut::test::version {
namespace {

const std::filesystem::path root = TAUT_SOURCE_DIR;

// The commit that a build of the sources in this folder would tell.
std::string commitOf(const std::filesystem::path& source) {
    const std::filesystem::path header = source / "../commit.h";
    const std::string line = "cmake -D SOURCE='" + source.string() + "' -D HEADER='" + header.string() + "' -P '" +
                             (source / "commit.cmake").string() + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
    std::string text = contentOf(header);
    const std::size_t open = text.find('"');
    return text.substr(open + 1, text.rfind('"') - open - 1);
}

TEST(Version, NamesTheCommitAndTheBits) {
    const std::regex form(
        "taut [0-9]+\\.[0-9]+\\.[0-9]+, commit ([0-9a-f]{10}(-dirty)?|unknown|.*-g[0-9a-f]+(-dirty)?)"
        ", bits " +
        std::to_string(world::resultBits) + "\n");
    EXPECT_TRUE(std::regex_match(run({"--version"}).out, form)) << run({"--version"}).out;
}

TEST(Version, TellsTheCommitOfItsOwnSourcesOrNone) {
    const TemporaryFolder folder;
    const std::filesystem::path source = folder / "outer/taut";
    std::filesystem::create_directories(source);
    std::string script = contentOf(root / "game/commit.cmake");
    writeText(source / "commit.cmake", script);
    EXPECT_EQ(commitOf(source), "unknown");

    const auto git = [](const std::filesystem::path& where, const std::string& words) {
        const std::string line = "cd '" + where.string() + "' && git -c user.name=a -c user.email=a@b " + words;
        return WEXITSTATUS(std::system((line + " >git.log 2>&1").c_str())) == 0;
    };
    if (std::system("git --version >/dev/null 2>&1") == 0) {
        // Within another checkout it is not that one's commit; as a checkout it is its own.
        ASSERT_TRUE(git(folder / "outer", "init -q .") && git(folder / "outer", "commit -q --allow-empty -m a"));
        EXPECT_EQ(commitOf(source), "unknown");
        ASSERT_TRUE(git(source, "init -q .") && git(source, "add commit.cmake") && git(source, "commit -q -m b"));
        const std::string clean = commitOf(source);
        EXPECT_TRUE(std::regex_match(clean, std::regex("[0-9a-f]{10}"))) << clean;
        writeText(source / "commit.cmake", script + "# changed\n");
        EXPECT_EQ(commitOf(source), clean + "-dirty");
        // `git archive` follows .gitattributes.
        std::filesystem::copy_file(root / ".gitattributes", source / ".gitattributes");
        std::filesystem::create_directory(source / "game");
        writeText(source / "game/commit.cmake", script);
        ASSERT_TRUE(git(source, "add .") && git(source, "commit -q -m c") &&
                    git(source, "archive -o ../../taut.tar HEAD game"));
        ASSERT_EQ(
            WEXITSTATUS(std::system(
                ("tar -C '" + folder.path().string() + "' -xf '" + (folder / "taut.tar").string() + "'").c_str())),
            0);
        EXPECT_EQ(commitOf(folder / "game"), commitOf(source));
    }
}

TEST(Changelog, BeginsWithThisVersionAndItsBits) {
    std::ifstream file(root / "game/changelog");
    std::string first, empty, bits;
    std::getline(file, first);
    std::getline(file, empty);
    std::getline(file, bits);
    const std::string said = run({"--version"}).out, version = said.substr(5, said.find(',') - 5);
    EXPECT_TRUE(first.starts_with("taut (" + version + ") ")) << first;
    EXPECT_TRUE(bits.starts_with("  * Bits " + std::to_string(world::resultBits) + ": "))
        << "game/changelog begins with what changed results: " << bits;
}

}  // namespace
}  // namespace taut::test::version
