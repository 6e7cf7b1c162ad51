#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/advice/bending_cells.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/fields/private/problems.h"
#include "taut/scene/fabrics.h"
#include "taut/scene/load.h"

namespace taut::game {
namespace {

using std::filesystem::path;

// The material as a scene gets it, and the title of its file.
struct Fabric {
    std::string title;
    world::MaterialSpec material;
};

Fabric read(const path& file) {
    const world::SceneSpec scene = scene::loadScene(file, loadOptions({}, false)).spec;
    const auto found = scene.materials.find(file.stem().string());
    if (found == scene.materials.end())
        throw core::Error(core::ErrorKind::badContent,
                          core::at({file.string()}) + fmt::format("it has no [material.{}]", file.stem().string()));
    return {scene.title, found->second};
}

// The numbers of the material, "stretch, shear", of which the comment begins with a word: measured, derived, chosen.
std::string numbersThatAre(const std::string& origin, const path& file) {
    std::istringstream lines(core::fileContent(file));
    std::vector<std::string> names;
    bool isOfMaterial = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with('[')) isOfMaterial = line == fmt::format("[material.{}]", file.stem().string());
        if (isOfMaterial && line.find("# " + origin) != std::string::npos)
            if (const std::string name = line.substr(0, line.find_first_of("_ "));
                names.empty() || names.back() != name)
                names.push_back(name);
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

int list(const std::vector<path>& files) {
    constexpr const char* row = "{:<12} {:>6}  {:>11}  {:>14}  {:<17} {:<37} {:<47} {}\n";
    printResult(row, "", "weight", "bending", "cells for", "", "", "", "");
    printResult(row, "fabric:", "g/m2", "length, mm", "1 %, 10 %, mm", "measured", "derived", "chosen", "");
    for (const path& file : files) {
        const Fabric fabric = read(file);
        const world::MaterialSpec& m = fabric.material;
        constexpr double gravity = 9.81;  // [m/s²]
        const double warp = m.rigidity.warp.value_or(0.0), weft = m.rigidity.weft.value_or(warp);
        const double u = world::bendingLength(warp, m.density, gravity);
        const double v = world::bendingLength(weft, m.density, gravity);
        const double least = std::min(u, v);
        printResult(row, file.stem().string(), fmt::format("{:.0f}", 1e3 * m.density),
                    fmt::format("{:.1f} x {:.1f}", 1e3 * u, 1e3 * v),
                    fmt::format("{:.1f}, {:.1f}", 1e3 * world::cellFor(0.01, least), 1e3 * world::cellFor(0.1, least)),
                    numbersThatAre("measured", file), numbersThatAre("derived", file), numbersThatAre("chosen", file),
                    fabric.title);
    }
    printResult(
        "\nIn a scene: material = \"fabric:denim\" of a cloth, or like = \"fabric:denim\" of a [material.NAME].\n");
    return static_cast<int>(ExitCode::ok);
}

int show(const std::string& name, const std::vector<path>& files) {
    const std::string stem =
        name.starts_with(scene::fabricPrefix) ? name.substr(std::string_view(scene::fabricPrefix).size()) : name;
    std::vector<std::string> known;
    for (const path& file : files) {
        known.push_back(file.stem().string());
        if (known.back() != stem) continue;
        writeResult(core::fileContent(file));
        return static_cast<int>(ExitCode::ok);
    }
    const std::string meant = fields::suggestion(stem, known);
    failUsage("there is no fabric \"{}\"; {}", stem, meant.empty() ? "taut materials lists them" : meant);
}

Action declareMaterials(Options& options) {
    const auto name = std::make_shared<std::string>();
    options.value("FABRIC", *name, "Fabric to print, with the source of every number");
    options.footer(
        "At the bending length stiffness and weight balance; the droop of a strip has an error of 1 % with cells of a "
        "seventh\n"
        "of it. Examples:\n"
        "  taut materials\n"
        "  taut materials denim\n"
        "  taut render drape --set cloth.tablecloth.material=fabric:silk -o out");
    return [name] {
        const std::vector<path> files = scene::fabricFiles(loadOptions({}, false).assetFolders);
        if (files.empty())
            throw core::Error(core::ErrorKind::inputOutput,
                              "there are no fabrics: the folder assets/fabrics is missing beside the program");
        return name->empty() ? list(files) : show(*name, files);
    };
}

}  // namespace

Command materialsCommand() {
    return {"materials", "List fabrics and the sources of their numbers", declareMaterials};
}

}  // namespace taut::game
