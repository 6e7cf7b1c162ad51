// The layering of the house: includes point one way, and third-party headers stay inside source files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace taut {
namespace {

using Folders = std::set<std::string>;
const std::filesystem::path source = TAUT_SOURCE_DIR;

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The words that follow `before` in a text, as far as they have letters and underscores.
std::vector<std::string> wordsAfter(const std::string& text, const std::string& before) {
    std::vector<std::string> words;
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
        const std::size_t begin = at + before.size();
        words.push_back(text.substr(begin, text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", begin) - begin));
    }
    return words;
}

// The folders of the engine from the ground up: the order in which it is built.
const std::vector<std::string> floors =
    wordsAfter(contentOf(source / "engine/CMakeLists.txt"), "add_subdirectory(taut/");

// The links of each folder, by which it may include: its own, and the links of these.
std::map<std::string, Folders> linked() {
    std::map<std::string, Folders> all;
    for (const std::string& folder : floors) {
        Folders& folders = all[folder];
        for (const std::string& other :
             wordsAfter(contentOf(source / "engine/taut" / folder / "CMakeLists.txt"), "taut::")) {
            folders.insert(other);
            const Folders below = all.contains(other) ? all.at(other) : Folders{};
            folders.insert(below.begin(), below.end());
        }
    }
    return all;
}

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
    for (const auto& entry : std::filesystem::directory_iterator(source / "engine/taut"))
        if (entry.is_directory())
            EXPECT_EQ(std::count(floors.begin(), floors.end(), entry.path().filename()), 1) << entry.path();
}

TEST(House, LinksPointDown) {
    for (auto folder = floors.begin(); folder != floors.end(); ++folder)
        for (const std::string& other :
             wordsAfter(contentOf(source / "engine/taut" / *folder / "CMakeLists.txt"), "taut::"))
            if (std::find(floors.begin(), floors.end(), other) != floors.end())
                EXPECT_NE(std::find(floors.begin(), folder, other), folder) << *folder << " links " << other;
}

TEST(House, IncludesPointOneWay) {
    std::size_t seen = 0;
    for (const auto& [folder, others] : linked())
        for (const Include& include : includesBelow(source / "engine/taut" / folder)) {
            if (!include.what.starts_with("taut/")) continue;
            const std::string first = include.what.substr(5, include.what.find('/', 5) - 5);
            ++seen;
            EXPECT_TRUE(first == folder || others.contains(first)) << include.file << " includes " << include.what;
        }
    EXPECT_GT(seen, 300U);  // the test reads real includes
}

// A file of tests that no list names is never compiled.
TEST(House, EveryTestIsBuilt) {
    for (const char* group : {"unit", "physics", "determinism", "golden"}) {
        const std::filesystem::path folder = source / "tests" / group;
        std::string lists;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".cmake") lists += contentOf(entry.path());
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (const std::string name = entry.path().filename(); name.ends_with("_test.cpp"))
                EXPECT_NE(lists.find(name), std::string::npos) << group << "/" << name;
    }
}

TEST(House, TheEngineDoesNotKnowTheProgram) {
    for (const Include& include : includesBelow(source / "engine"))
        EXPECT_FALSE(include.what.starts_with("game/")) << include.file;
}

// Bullet, GL, TOML and the pictures' codecs are seen by sources only, so that they can be replaced in one place.
TEST(House, ThirdPartyHeadersStayOutOfPublicOnes) {
    static constexpr const char* inside[] = {"bt",   "Bullet", "LinearMath", "toml",     "GL/",    "EGL/",
                                             "glad", "stb_",   "libdeflate", "tbb",      "oneapi", "nlohmann",
                                             "CLI",  "spng",   "turbojpeg",  "tiny_gltf"};
    const Folders inner = {"gl.h", "bullet_convex.h", "gltf_model.h", "mesh_tree.h"};  // private to one folder
    for (const Include& include : includesBelow(source / "engine"))
        if (include.file.extension() == ".h" &&
            std::any_of(std::begin(inside), std::end(inside),
                        [&](const char* start) { return include.what.starts_with(start); }))
            EXPECT_TRUE(inner.contains(include.file.filename())) << include.file << " includes " << include.what;
}

// A heavy library is read by the compiler once, and can be replaced in one place.
TEST(House, HeavyLibrariesHaveOneDoorEach) {
    const std::map<std::string, std::string> doors = {{"CLI/", "game/command_line.cpp"}};
    for (const auto& [library, door] : doors) {
        std::set<std::string> files;
        for (const char* folder : {"engine", "game"})
            for (const Include& include : includesBelow(source / folder))
                if (include.what.starts_with(library)) files.insert(relative(include.file, source));
        EXPECT_EQ(files, std::set<std::string>{door});
    }
}

// Everything of a source file that people read.
struct Prose {
    std::string comments, literals;
};

Prose proseOf(const std::string& code) {
    Prose prose;
    for (std::size_t at = 0; at < code.size(); ++at) {
        if (code.compare(at, 2, "//") == 0) {
            const std::size_t begin = at + 2;
            at = std::min(code.find('\n', at), code.size());
            prose.comments += code.substr(begin, at - begin) + " ";
        } else if (code.compare(at, 2, "R\"") == 0) {
            const std::size_t begin = code.find('(', at) + 1;
            const std::string ending = ")" + code.substr(at + 2, begin - 1 - (at + 2)) + "\"";
            const std::size_t end = code.find(ending, begin);
            prose.literals += code.substr(begin, end - begin) + "\n";
            at = end + ending.size() - 1;
        } else if (code[at] == '"') {
            const std::size_t begin = ++at;
            while (code.at(at) != '"') at += code[at] == '\\' ? 2 : 1;
            prose.literals += code.substr(begin, at - begin) + "\n";
        } else if (code[at] == '\'' && std::isalnum(static_cast<unsigned char>(code[at - 1])) == 0) {
            at = code.find('\'', at + (code.at(at + 1) == '\\' ? 3 : 2));
        }
    }
    return prose;
}

// Words and phrases that plain technical English does not need, found in a text.
std::vector<std::string> oldWordsIn(const std::string& text) {
    static const std::vector<std::string> phrases = {
        "dear",        "likewise",   "whatever", "those that", "of both",   "is told", "are told", "lets go", "let go",
        "taken again", "lies still", "tremble",  "trembles",   "trembling", "by it",   "is whole", "said",    "what",
    };
    std::string plain = " ";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const char letter = std::isalpha(byte) != 0 ? static_cast<char>(std::tolower(byte)) : ' ';
        if (letter != ' ' || plain.back() != ' ') plain += letter;
    }
    plain += ' ';
    std::vector<std::string> found;
    for (const std::string& phrase : phrases)
        for (std::size_t at = plain.find(" " + phrase + " "); at != std::string::npos;
             at = plain.find(" " + phrase + " ", at + 1))
            found.push_back("..." + plain.substr(at, 60));
    return found;
}

// Documents, helps and messages, and comments in the rooms that have been rewritten.
TEST(House, WritesPlainWords) {
    static const Folders headersNotYet = {"contact"}, sourcesNotYet = {"contact", "joints", "render"};
    const auto expectPlain = [](const std::filesystem::path& file, const std::string& text) {
        EXPECT_EQ(oldWordsIn(text), std::vector<std::string>()) << file;
    };
    for (const char* folder : {"engine", "game", "tests"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
            const std::filesystem::path& file = entry.path();
            const bool isHeader = file.extension() == ".h", isTest = *folder == 't';
            if (file.extension() == ".md") expectPlain(file, contentOf(file));
            if (!isHeader && file.extension() != ".cpp") continue;
            const Prose prose = proseOf(contentOf(file));
            if (!isTest) expectPlain(file, prose.literals);  // of tests: also names and pieces of scenes
            const std::filesystem::path below = file.lexically_relative(source / "engine/taut");
            const std::string room = *folder == 'e' ? below.begin()->string() : folder;
            const bool isStage = file.stem().string().starts_with("contact_stage");  // as the room that it calls
            if (!(isHeader ? headersNotYet : sourcesNotYet).contains(room) && !isStage)
                expectPlain(file, prose.comments);
        }
    expectPlain("README.md", contentOf(source / "README.md"));
    EXPECT_EQ(oldWordsIn("What is dear, is told. Whatever").size(), 4U);  // the words are found
}

TEST(House, TheTopLevelHoldsWhatWasAgreed) {
    const Folders agreed = {"CMakeLists.txt", "engine", "game", "shaders", "assets", "tests", "README.md", "out"};
    for (const auto& entry : std::filesystem::directory_iterator(source)) {
        const std::string name = entry.path().filename();
        if (!name.starts_with(".") && !name.starts_with("build")) EXPECT_TRUE(agreed.contains(name)) << name;
    }
}

}  // namespace
}  // namespace taut
