// The layering of the house: includes point one way, and what belongs inside a source file stays there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

namespace taut {
namespace {

using Folders = std::set<std::string>;
const std::filesystem::path source = TAUT_SOURCE_DIR;

// What each folder may include besides itself.
const std::map<std::string, Folders> allowed = {
    {"core", {}},
    {"ode", {"core"}},
    {"ecs", {"core"}},
    {"view", {"core"}},
    {"image", {"core"}},
    {"mechanics", {"core", "ode"}},
    {"collision", {"core", "view"}},
    {"render", {"core", "view", "image"}},
    {"world", {"core", "ode", "ecs", "view", "mechanics", "collision"}},
    {"check", {"core", "ecs", "view", "ode", "mechanics", "world"}},
    {"scene", {"core", "ode", "ecs", "view", "mechanics", "collision", "world", "check"}},
    {"pipeline", {"core", "view", "image", "world", "scene", "render"}},
    {"report", {"core", "image"}},
    {"study", {"core", "ode", "ecs", "view", "mechanics", "collision", "world", "scene", "report"}},
    {"regression",
     {"core", "view", "image", "mechanics", "collision", "render", "ecs", "ode", "world", "check", "scene", "pipeline",
      "report"}},
    {"live", {"core", "ecs", "mechanics", "ode", "collision", "view", "image", "render", "world", "scene"}},
};

struct Include {
    std::filesystem::path file;
    std::string what;
};

std::vector<Include> includesBelow(const std::filesystem::path& folder) {
    std::vector<Include> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        std::ifstream file(entry.path());
        for (std::string text; std::getline(file, text);) {
            if (!text.starts_with("#include ")) continue;
            const std::size_t open = text.find_first_of("<\""), close = text.find_first_of(">\"", open + 1);
            if (close != std::string::npos) all.push_back({entry.path(), text.substr(open + 1, close - open - 1)});
        }
    }
    return all;
}

TEST(House, EveryFolderOfTheEngineHasItsPlace) {
    for (const auto& entry : std::filesystem::directory_iterator(source / "engine"))
        if (entry.is_directory()) {
            EXPECT_TRUE(allowed.contains(entry.path().filename())) << entry.path();
        }
}

TEST(House, IncludesPointOneWay) {
    std::size_t seen = 0;
    for (const auto& [folder, others] : allowed)
        for (const Include& include : includesBelow(source / "engine" / folder)) {
            if (!include.what.starts_with("taut/")) continue;
            const std::string first = include.what.substr(5, include.what.find('/', 5) - 5);
            ++seen;
            EXPECT_TRUE(first == folder || others.contains(first)) << include.file << " includes " << include.what;
        }
    EXPECT_GT(seen, 300U);  // the test reads real includes
}

TEST(House, TheEngineDoesNotKnowTheProgram) {
    for (const Include& include : includesBelow(source / "engine"))
        EXPECT_FALSE(include.what.starts_with("game/")) << include.file;
}

// Bullet, GL, TOML and the pictures' codecs are seen by sources only, so that they can be replaced in one place.
TEST(House, ThirdPartyHeadersStayOutOfPublicOnes) {
    static constexpr const char* inside[] = {"bt",   "Bullet",     "LinearMath", "toml",   "GL/",      "EGL/", "glad",
                                             "stb_", "libdeflate", "tbb",        "oneapi", "nlohmann", "CLI"};
    const Folders inner = {"gl.h"};  // private to one folder, behind its pimpl
    for (const Include& include : includesBelow(source / "engine"))
        if (include.file.extension() == ".h" &&
            std::any_of(std::begin(inside), std::end(inside),
                        [&](const char* start) { return include.what.starts_with(start); })) {
            EXPECT_TRUE(inner.contains(include.file.filename())) << include.file << " includes " << include.what;
        }
}

TEST(House, FilesStayShort) {
    for (const char* folder : {"engine", "game", "tests"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
            std::ifstream file(entry.path());
            int lines = 0;
            for (std::string text; std::getline(file, text);) ++lines;
            EXPECT_LE(lines, 400) << entry.path();
        }
}

TEST(House, TheTopLevelHoldsWhatWasAgreed) {
    const Folders agreed = {"CMakeLists.txt", "engine", "game", "shaders", "assets", "tests", "README.md", "out"};
    for (const auto& entry : std::filesystem::directory_iterator(source)) {
        const std::string name = entry.path().filename();
        if (!name.starts_with(".") && !name.starts_with("build")) {
            EXPECT_TRUE(agreed.contains(name)) << name;
        }
    }
}

}  // namespace
}  // namespace taut
