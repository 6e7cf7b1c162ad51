
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

// How the comment at the top of a file begins.
std::string beginningOf(const std::filesystem::path& file) {
    std::istringstream lines(core::fileContent(file));
    std::string comment;
    for (std::string line; std::getline(lines, line) && line.starts_with("# ");)
        comment += (comment.empty() ? "" : " ") + line.substr(2);
    std::size_t end = comment.size();
    for (const char* stop : {". ", "; ", ": "}) end = std::min(end, comment.find(stop));
    comment.resize(end);
    if (comment.ends_with('.')) comment.pop_back();
    return comment;
}

void listFiles(const char* what, const char* folder, const std::vector<std::string>& names) {
    printResult("{}\n", what);
    for (const std::string& name : names)
        printResult("  {:<14} {}\n", name, beginningOf(assetFolder() / folder / (name + ".toml")));
}

Action declareList(Options& options) {
    options.footer(
        "Examples:\n"
        "  taut render flag\n"
        "  taut test bent-bar");
    return [] {
        listFiles("Scenes", "scenes", shippedScenes());
        listFiles("\nScenarios: of the scene of that name, or complete", "scenarios", shippedScenarios());
        return static_cast<int>(ExitCode::ok);
    };
}

}  // namespace

Command listCommand() {
    return {"list", "List the shipped scenes and scenarios", declareList};
}

}  // namespace taut::game
