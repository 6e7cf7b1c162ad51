#include "taut/study/contact_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "taut/check/figures.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

constexpr double ticksPerSecond = 60;

std::vector<ContactProblem> makeProblems() {
    constexpr double g = 9.81, angle = 0.5, friction = 0.3;
    return {{.name = "ball-bounces",
             .title = "A ball bounces",
             .about = "energy after a bounce over that before: e² = 0.64",
             .scene = R"([solid.ball]
shape = "sphere"
radius = 0.1
position = [0, 0.5, 0]
[collider.ground]
shape = "plane"
position = [0, -0.1, 0]
restitution = 0.8
)",
             .seconds = 0.5,
             .fewestSteps = 4,
             .expression = "energy(solid.ball)",
             .isShare = true,
             .known = 0.64},
            {.name = "ball-rolls",
             .title = "A ball rolls",
             .about = "energy after 5 s over that before: 1",
             .scene = R"([solid.ball]
shape = "sphere"
radius = 0.1
velocity = [2, 0, 0]
spin_rad_per_s = [0, 0, -20]
[collider.ground]
shape = "plane"
position = [0, -0.1, 0]
friction = 0.5
)",
             .seconds = 5.0,
             .fewestSteps = 4,
             .expression = "energy(solid.ball)",
             .isShare = true,
             .known = 1.0},
            {.name = "box-slides",
             .title = "A box slides down a slope",
             .about = "way in 1 s: ½ g (sin α - μ cos α) t²",
             .scene = fmt::format(R"([world]
gravity = [{}, {}, 0]
[solid.box]
shape = "box"
size = [0.3, 0.1, 0.2]
[collider.ground]
shape = "plane"
position = [0, -0.05, 0]
friction = {}
)",
                                  g * std::sin(angle), -g * std::cos(angle), friction),
             .seconds = 1.0,
             .fewestSteps = 4,
             .expression = "position(solid.box).x",
             .known = 0.5 * g * (std::sin(angle) - friction * std::cos(angle))},
            {.name = "sheet-falls",
             .title = "A sheet falls on a held one",
             .about = "least gap: the thickness, 8 mm",
             .scene = R"([material.linen]
stretch_N_per_m = 100
density_kg_per_m2 = 0.2
damping_time_s = 1e-4
[cloth.lower]
material = "linen"
size = [0.4, 0.4]
cells = [8, 8]
origin = [-0.2, 0, -0.2]
down = [0, 0, 1]
hold = ["all"]
thickness = 0.004
touch = "others"
[cloth.upper]
material = "linen"
size = [0.3, 0.3]
cells = [10, 10]
origin = [-0.14, 0.1, -0.13]
across = [1, 0.1, 0]
down = [0, 0, 1]
velocity = [0, -3, 0]
thickness = 0.004
touch = "all"
)",
             .seconds = 0.5,
             .fewestSteps = 32,
             .expression = "gap(cloth.upper, cloth.lower)",
             .taken = Taken::least,
             .known = 0.008},
            {.name = "rope-strikes",
             .title = "A rope strikes itself, undamped, e = 0.8",
             .about = "largest energy over that at the start: 1",
             .scene = R"([world]
gravity = [0, 0, 0]
[contact]
friction = 0
restitution = 0.8
[rope.rope]
ends = [[0, 0, 0], [0.6, 0, 0]]
segments = 15
radius = 0.02
mass_kg = 0.5
stretch_N = 1000
damping_time_s = 0
drag_per_s = 0
touch = "all"
[[at]]
t = 0
do = "push"
target = "rope.rope@start"
impulse_Ns = [0.3, 0.2, 0.06]
[[at]]
t = 0
do = "push"
target = "rope.rope@end"
impulse_Ns = [-0.3, 0.06, -0.1]
[[at]]
t = 0
do = "push"
target = "rope.rope@50%"
impulse_Ns = [0.03, -0.24, 0.06]
)",
             .seconds = 1.0,
             .fewestSteps = 32,
             .expression = "energy(rope.rope)",
             .taken = Taken::most,
             .isShare = true,
             .known = 1.0}};
}

ContactRun runOf(const ContactProblem& problem, int steps, int detections) {
    ContactRun run;
    run.problem = problem.name;
    run.steps = steps;
    run.detections = detections;
    const std::string text =
        "schema = 1\n[run]\nseconds = 10\nfps = " + fmt::format("{}", ticksPerSecond) +
        "\n[solver]\nprecision = \"double\"\ndt = " + fmt::format("{}", 1 / (ticksPerSecond * steps)) + "\n" +
        problem.scene;
    scene::LoadOptions options;
    options.overrides = {"contact.detections=" + std::to_string(detections)};
    world::World world(scene::loadSceneText(text, problem.name + ".toml", options).spec, {.threads = 1});
    check::Figures figures = check::Figures::parse(problem.expression);
    const int ticks = static_cast<int>(std::lround(problem.seconds * ticksPerSecond));
    double first = 0;
    for (int tick = 0; tick < ticks; ++tick) {
        const std::clock_t start = std::clock();
        if (world.advance()) {
            run.hasEnded = false;
            break;
        }
        run.milliseconds += 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / ticks;
        const double value = figures.of(world).front();
        if (tick == 0) first = run.value = value;
        run.value = problem.taken == Taken::least  ? std::min(run.value, value)
                    : problem.taken == Taken::most ? std::max(run.value, value)
                                                   : value;
        run.crossings = std::max(run.crossings, static_cast<int>(world.metrics().crossings));
    }
    if (problem.isShare) run.value /= first;
    run.error = run.value / problem.known - 1;
    if (problem.taken == Taken::least) run.error = std::min(run.error, 0.0);
    if (problem.taken == Taken::most) run.error = std::max(run.error, 0.0);
    return run;
}

}  // namespace

std::span<const ContactProblem> contactProblems() {
    static const std::vector<ContactProblem> all = makeProblems();
    return all;
}

ContactStudy studyContact(const ContactSettings& settings) {
    ContactStudy study;
    double done = 0;
    const auto all = static_cast<double>(contactProblems().size());
    for (const ContactProblem& problem : contactProblems()) {
        done += 1;
        if (!settings.problems.empty() && !core::contains(settings.problems, problem.name)) continue;
        std::vector<ContactRun> runs;
        for (const int factor : settings.steps)
            for (const int detections : settings.detections) {
                const int steps = factor * problem.fewestSteps;
                if (detections > steps) continue;
                if (settings.listener.isStopped()) study.isInterrupted = true;
                if (study.isInterrupted) return study;
                settings.listener.report((done - 1) / all,
                                         fmt::format("{}, {} steps, {} detections", problem.name, steps, detections));
                runs.push_back(runOf(problem, steps, detections));
            }
        study.runs.insert(study.runs.end(), runs.begin(), runs.end());
    }
    settings.listener.report(1.0, "");
    return study;
}

}  // namespace taut::study
