// Two hundred scenarios, each with a few accidents: every one is refused with a message or runs for a while.
#include <random>

#include "taut/check/watcher.h"
#include "taut/core/error.h"
#include "taut/scene/private/body_size.h"
#include "taut/spec/ticks.h"
#include "unit/check_support.h"

namespace taut::check {
namespace {

// A little of everything that a scenario can say, quick to run.
const std::string scenario = R"toml(schema = 1
title = "everything that happens"
run = { fps = 30, seconds = 0.4 }
[hand]
anywhere = false
strength_N_per_m = 80
[material.m]
stretch_N_per_m = 100
break_strain = 0.8
yield_strain = 0.3
[cloth.c]
size = [1, 1]
cells = [5, 5]
origin = [0, 2, 0]
material = "m"
hold = ["top-left"]
[rope.r]
ends = [[-1, 1, 0], [-2, 1, 0]]
segments = 6
stretch_N = 100
[block.b]
size = [0.3, 0.3, 0.3]
cells = [1, 2, 1]
position = [2, 1, 0]
young_Pa = 2000
bulk_Pa = 1000
[net.n]
points = [{ name = "p", position = [0, 3, 1] }, { name = "q", position = [0, 4, 1], hold = true }]
springs = [{ a = "p", b = "q", stiffness_N_per_m = 10 }]
[wind.w]
velocity = [1, 0, 2]
gust = { amplitude = 1, period_s = 0.5, seed = 3 }
[collider.ball]
shape = "sphere"
position = [0.5, 1, 0]
radius = 0.2
[collider.ground]
shape = "plane"
[camera.main]
eye = [0, 1, 5]
[[at]]
t = 0.05
do = "grab"
id = "h"
target = "cloth.c@bottom-right"
radius = 0.3
strength_N_per_m = 50
[[at]]
t = 0.1
do = "move"
id = "h"
to = [1, 1, 1]
over_s = 0.1
ease = "out"
[[at]]
t = 0.3
do = "release"
id = "h"
[[at]]
t = 0.05
do = "push"
target = "rope.r@50%"
impulse_Ns = [0, 0.5, 0]
[[at]]
t = 0.1
do = "hold"
target = "rope.*@start"
[[at]]
t = 0.15
do = "free"
target = "cloth.c@(0,0)"
[[at]]
t = 0.1
do = "cut"
target = "cloth.c"
segment = [[0, 0.5], [1, 0.5]]
[[at]]
t = 0.15
do = "cut"
target = "rope.r"
plane = [[-1.6, 0, 0], [1, 0, 0]]
[[at]]
t = 0.2
do = "add-mass"
target = "net.n@p"
near = [0, 3, 1]
mass_kg = 0.5
[[at]]
t = 0.1
do = "ramp"
key = "wind.w.velocity"
to = [5, 0, 0]
over_s = 0.1
[[at]]
t = 0.1
do = "ramp"
key = "material.m.stretch_N_per_m"
to = 200
over_s = 0.2
[[at]]
t = 0.1
do = "move"
target = "collider.ball"
to = [0.5, 1.5, 0]
rotation_deg = [0, 30, 0]
over_s = 0.2
[[at]]
t = 0.2
do = "spawn"
target = "block.b"
[[check]]
that = "max_strain(cloth.*) < 0.9"
[[check]]
that = "0 < height(rope.r) < 3 * (distance(net.n@p, [0, 0, 0]) + 1)"
at = 0.2
[[check]]
that = "speed(block.b) < 10"
from = 0.25
[[golden]]
frames = [3, 8]
)toml";

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        lines.back() += c;
        if (c == '\n') lines.emplace_back();
    }
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line;
    return text;
}

// A number of the text, replaced by another.
std::string withOtherNumber(std::string text, std::mt19937& random) {
    static const char* numbers[] = {"0", "-1", "1e-3", "0.25", "7", "1e9", "nan", "-0.0", "1e-300", "0.2"};
    for (std::size_t at = random() % text.size(); at < text.size(); ++at) {
        const bool isDigit = text[at] >= '0' && text[at] <= '9';
        if (!isDigit || at == 0 || std::string(" [-,").find(text[at - 1]) == std::string::npos) continue;
        const std::size_t end = std::min(text.find_first_not_of("0123456789.e", at), text.size());
        return text.replace(at, end - at, numbers[random() % std::size(numbers)]);
    }
    return text;
}

// A word of the text, replaced by another of its words.
std::string withOtherWord(std::string text, std::mt19937& random) {
    static const char* words[] = {"grab",
                                  "move",
                                  "release",
                                  "cut",
                                  "spawn",
                                  "cloth.c",
                                  "rope.r",
                                  "block.b",
                                  "collider.ball",
                                  "at",
                                  "net.n@p",
                                  "hold",
                                  "near",
                                  "radius",
                                  "target",
                                  "id",
                                  "over_s",
                                  "@all",
                                  "speed",
                                  "volume",
                                  "wind.w.velocity",
                                  "world.gravity",
                                  "segment",
                                  "max_strain(rope.*)"};
    const std::size_t start = text.find_first_of("abcdefghijklmnopqrstuvwxyz", random() % text.size());
    if (start == std::string::npos) return text;
    const std::size_t end = std::min(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_.@", start), text.size());
    return text.replace(start, end - start, words[random() % std::size(words)]);
}

std::string mangled(std::string text, std::mt19937& random) {
    std::vector<std::string> lines = linesOf(text);
    const std::size_t a = random() % lines.size(), b = random() % lines.size();
    switch (random() % 7) {
        case 0: std::swap(lines[a], lines[b]); return joined(lines);
        case 1: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a)); return joined(lines);
        case 2: lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), lines[b]); return joined(lines);
        case 3: text[random() % text.size()] = static_cast<char>(random() % 256); return text;
        case 4: return withOtherWord(text, random);
        default: return withOtherNumber(text, random);
    }
}

// Whether the scenario ran; one that asks for very small steps or very many points is left alone.
bool runs(const world::SceneSpec& spec) {
    if (scene::sizeOf(spec).points > 2000) return true;
    world::World world(spec, {.threads = 1});
    for (const world::IslandInfo& island : world.islands())
        if (island.substeps > 2000) return true;
    Watcher watcher(spec);
    watcher.look(world);
    const std::int64_t last = std::min<std::int64_t>(world::Ticks(spec.run).last(), 22);
    for (std::int64_t i = 0; i < last; ++i) {
        if (world.advance()) return true;  // it diverged, and reported it
        watcher.look(world);
    }
    EXPECT_EQ(watcher.results().size(), spec.checks.size());
    return true;
}

TEST(CheckRobustness, MangledScenariosRunOrLeadToAMessage) {
    std::mt19937 random(3);
    int ran = 0, refused = 0, failedLate = 0;
    for (int i = 0; i < 200; ++i) {
        std::string text = scenario;
        for (std::size_t accidents = random() % 3 == 0 ? 2 : 1; accidents > 0 && !text.empty(); --accidents)
            text = mangled(text, random);
        SCOPED_TRACE(text);
        bool isLoaded = false;
        try {
            scene::LoadOptions options;
            options.memoryLimit = 16e9;
            const world::SceneSpec spec = scene::loadSceneText(text, "s.toml", options).spec;
            isLoaded = true;
            ran += runs(spec) ? 1 : 0;
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
            EXPECT_NE(std::string(error.what()), "");
            ++(isLoaded ? failedLate : refused);
        }
    }
    // All must happen, or the accidents are too rough or too gentle; few faults may show only when it runs.
    EXPECT_GT(ran, 20);
    EXPECT_GT(refused, 50);
    EXPECT_LT(failedLate, 10);
}

TEST(CheckRobustness, TheScenarioItselfRuns) {
    const world::SceneSpec spec = scene::loadSceneText(scenario, "s.toml", {}).spec;
    world::World world(spec, {.threads = 1});
    Watcher watcher(spec);
    watcher.look(world);
    for (std::int64_t i = 0; i < world::Ticks(spec.run).last(); ++i) {
        play(world, 1);
        watcher.look(world);
    }
    for (const Result& result : watcher.results()) EXPECT_TRUE(result.passed) << result.that << ": " << result.reason;
}

}  // namespace
}  // namespace taut::check
