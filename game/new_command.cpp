#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "game/outputs.h"
#include "game/shell_word.h"
#include "game/usage.h"
#include "taut/core/whole_file.h"
#include "taut/fields/field.h"

namespace taut::game {
namespace {

struct NewFlags {
    std::string name;
    std::vector<std::string> with;
    bool yes = false;
};

// The parts of a new scene. In the text {name} is the last part of a name, {x}, {left} and {right} are places along x.
struct Piece {
    std::string_view word;
    std::string_view text;
};
constexpr Piece pieces[] = {
    {"cloth", R"(
[material.{name}]                     # per metre of cloth, for any cells
density_kg_per_m2 = 0.25
stretch_N_per_m = 900.0
bending_rigidity_N_m = 3e-5          # silk has 1e-6, denim 1e-4
damping_time_s = 2e-4

[cloth.{name}]                        # falls flat on the ball
size = [1.2, 1.2]                    # metres
cells = [32, 32]
origin = [{left}, 1.15, -0.6]         # one corner; y is up
down = [0.0, 0.0, 1.0]
material = "{name}"
thickness = 0.006
finish = {{ pattern = "checker", colour = "#a8322d", accent = "#f0e6d2", repeat_m = 0.2, weave = 0.5 }}

[collider.{name}]
shape = "sphere"
position = [{x}, 0.5, 0.0]
radius = 0.35
finish = {{ colour = "#d8c9a8" }}
)"},
    {"rope", R"(
[rope.{name}]                         # swings from one end
ends = [[{left}, 1.7, 0.0], [{right}, 1.7, 0.0]]
segments = 40
mass_kg = 0.3
stretch_N = 2000.0                   # force that would stretch it to twice its length
damping_time_s = 2e-4
drag_per_s = 0.3
radius = 0.015
hold = ["start"]
finish = {{ colour = "#c89b4a" }}
)"},
    {"block", R"(
[block.{name}]                        # falls, and wobbles on the ground
size = [0.5, 0.5, 0.5]               # metres
cells = [6, 6, 6]
position = [{x}, 1.0, 0.0]          # its centre
rotation_deg = [25.0, 20.0, 10.0]
density_kg_per_m3 = 200.0
young_Pa = 20000.0                   # stiffness
poisson = 0.43                       # how much it narrows when it is stretched
damping_time_s = 4e-3
finish = {{ colour = "#3f8f6b", accent = "#dff0d8", pattern = "checker", repeat_m = 0.125 }}
)"},
    {"net", R"(
[net.{name}]                          # points and springs, one by one
points = [
  {{ name = "hook", position = [{x}, 1.8, 0.0], mass_kg = 0.1, hold = true }},
  {{ name = "left", position = [{left}, 1.4, 0.0], mass_kg = 0.2 }},
  {{ name = "right", position = [{right}, 1.4, 0.0], mass_kg = 0.2 }},
  {{ name = "low", position = [{x}, 0.9, 0.3], mass_kg = 0.4 }},
]
springs = [
  {{ a = "hook", b = "left", stiffness_N_per_m = 200.0 }},
  {{ a = "hook", b = "right", stiffness_N_per_m = 200.0 }},
  {{ a = "left", b = "right", stiffness_N_per_m = 200.0 }},
  {{ a = "left", b = "low", stiffness_N_per_m = 120.0 }},
  {{ a = "right", b = "low", stiffness_N_per_m = 120.0 }},
]
damping_time_s = 2e-3
radius = 0.02
finish = {{ colour = "#35648f" }}
)"},
    {"solid", R"(
[solid.{name}]                        # a wall of fifteen boxes
shape = "box"
size = [0.2, 0.2, 0.2]               # metres
edge = 0.015                         # of its rounding
position = [{x}, 0.1, 0.0]          # the centre of the first
array = {{ count = [3, 5, 1], step_x = [0.205, 0.0, 0.0], step_y = [0.0, 0.2, 0.0] }}
density_kg_per_m3 = 300.0
friction = 0.5
finish = {{ colour = "#c9a36b" }}

[solid.{name}-ball]                   # flies into it
shape = "sphere"
radius = 0.12
position = [{x}, 0.8, 1.0]
velocity = [0.6, 1.0, -3.5]
density_kg_per_m3 = 900.0
finish = {{ colour = "#35648f" }}
)"},
    {"hinge", R"(
[solid.{name}-chest]
shape = "box"
size = [0.9, 0.5, 0.6]               # metres
position = [{x}, 0.25, 0.0]         # its centre
finish = {{ colour = "#8a5a33" }}

[solid.{name}-lid]                    # stands open, and falls shut
shape = "box"
size = [0.9, 0.06, 0.6]
position = [{x}, 0.7975, -0.2513]
rotation_deg = [-75.0, 0.0, 0.0]
finish = {{ colour = "#c9a36b" }}

[[joint]]
kind = "hinge"
a = "solid.{name}-chest"
b = "solid.{name}-lid"
place = [0.0, 0.25, -0.3]             # in the axes of the chest: its upper back edge
axis = [1.0, 0.0, 0.0]
touch = true                         # the lid stops on the chest
damping_N_m_s = 2.0
)"},
};

constexpr std::string_view head = R"(# A scene to start from; taut manual scenes describes its keys
schema = 1
title = "{title}"
run = {{ fps = 60, seconds = 4.0 }}
)";
constexpr std::string_view surroundings = R"(
[collider.ground]
shape = "plane"

[camera.main]
eye = [{eyeX}, 1.5, {eyeZ}]
target = [0.0, 0.85, 0.0]
fov_deg = 40.0
)";

std::vector<std::string> words() {
    std::vector<std::string> all;
    for (const Piece& piece : pieces) all.emplace_back(piece.word);
    return all;
}

std::string number(double value) {
    return fmt::format("{:.2f}", value == 0.0 ? 0.0 : value);  // no -0.00
}

// The pieces stand side by side, and the camera so far off that it sees them all.
std::string sceneText(const std::string& title, const std::vector<std::string>& with) {
    constexpr double apart = 1.7, half = 0.6;  // [m]
    const auto count = static_cast<double>(with.size());
    std::string text = fmt::format(fmt::runtime(head), fmt::arg("title", title));
    for (std::size_t i = 0; i < with.size(); ++i) {
        const auto piece = std::ranges::find(pieces, with[i], &Piece::word);
        const auto before = std::count(with.begin(), with.begin() + static_cast<std::ptrdiff_t>(i), with[i]);
        const std::string name = before == 0 ? "first" : fmt::format("first{}", before + 1);
        const double x = apart * (static_cast<double>(i) - 0.5 * (count - 1.0));
        text += fmt::format(fmt::runtime(piece->text), fmt::arg("name", name), fmt::arg("x", number(x)),
                            fmt::arg("left", number(x - half)), fmt::arg("right", number(x + half)));
    }
    return text + fmt::format(fmt::runtime(surroundings), fmt::arg("eyeX", number(0.4 + 0.2 * count)),
                              fmt::arg("eyeZ", number(1.75 + 0.95 * count)));
}

int writeNew(const NewFlags& flags) {
    const std::filesystem::path given(flags.name);
    const std::string title = given.extension() == ".toml" ? given.stem().string() : given.filename().string();
    if (!fields::isName(title)) failUsage("\"{}\" cannot be the name of a scene: use letters, digits, - and _", title);
    const std::filesystem::path file = given.parent_path() / (title + ".toml");
    permitOverwritingFile(file, flags.yes ? Overwrite::yes : Overwrite::ask);
    core::prepareFolderOf(file);
    core::writeWholeFile(file, sceneText(title, flags.with.empty() ? std::vector<std::string>{"cloth"} : flags.with));
    const std::string word = shellWord(file.string());
    printResult("{} is written. Next:\n  taut check {}\n  taut render {} -o {}\n  taut play {}\n", file.string(), word,
                word, shellWord(title + ".mp4"), word);
    return static_cast<int>(ExitCode::ok);
}

Action declareNew(Options& options) {
    const auto flags = std::make_shared<NewFlags>();
    options.value("NAME", flags->name, "Name of the scene: writes NAME.toml").required();
    options.value("--with", flags->with, "Body of the scene, default cloth; repeatable: side by side")
        .oneOf(words())
        .oneValue();
    options.flag("-y,--yes", flags->yes, "Overwrite existing files");
    options.footer(
        "Examples:\n"
        "  taut new first\n"
        "  taut new first --with block --with rope");
    return [flags] { return writeNew(*flags); };
}

}  // namespace

Command newCommand() {
    return {"new", "Write a small scene", declareNew};
}

}  // namespace taut::game
