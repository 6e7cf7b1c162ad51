#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/lab.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "game/scene_search.h"
#include "taut/core/error.h"
#include "taut/pipeline/machine.h"
#include "taut/scene/load.h"
#include "taut/study/plan.h"
#include "taut/study/plan_changes.h"
#include "taut/study/plan_text.h"

namespace taut::game {
namespace {

struct PlanFlags : SearchFlags {
    double effort = 20.0;
};

study::Plan search(const world::SceneSpec& spec, const PlanFlags& flags, const std::atomic<bool>& stop) {
    LabProgress line("plan", flags.quiet, stop);
    study::PlanSettings settings;
    settings.effort = 1e9 * flags.effort;
    settings.listener = {&stop, [&line](double done, const std::string& doing) { line.show(done, doing); }};
    return study::makePlan(spec, settings);
}

// Bodies with `like` change with their model.
void expectNoOtherChanges(const SearchedScene& scene, const study::Plan& plan, const std::string& changed) {
    const world::SceneSpec now = scene::loadSceneText(changed, scene.file.string(), loadOptions()).spec;
    for (const scene::Change& change : study::planChanges(scene.spec, now))
        if (std::ranges::none_of(plan.changes, [&](const scene::Change& planned) { return planned.key == change.key; }))
            throw core::Error(core::ErrorKind::badContent,
                              fmt::format("{}: {} would change too, by its like; give it a value of its own first",
                                          scene.file.string(), change.key));
    if (plan.unseen() > 0)
        printNote("warning: the time from {:.3g} s to {:.3g} s was not simulated; look at the film\n", plan.seconds,
                  plan.runSeconds);
}

int plan(const PlanFlags& flags) {
    return searchScene(
        flags,
        [&](const SearchedScene& scene, const std::atomic<bool>& stop) {
            const study::Plan plan = search(scene.spec, flags, stop);
            return Found{study::planSummary(plan), study::planJson(plan, machineFacts(pipeline::machine())),
                         plan.isMet(), plan.changes,
                         [&scene, plan](const std::string& changed) { expectNoOtherChanges(scene, plan, changed); }};
        });
}

Action declarePlan(Options& options) {
    const auto flags = std::make_shared<PlanFlags>();
    addSearchFlags(options, *flags, "A scene file, or a shipped scene, with [need]");
    options
        .value("--effort", flags->effort,
               "Largest cost of all runs together, in 1e9 springs and points times evaluations: 1 takes about 5 s")
        .within(1e-3, 1e6, "times 1e9: 0.2 means 2e8")
        .showDefault();
    options.footer(
        "The cost of a candidate is springs, points and 5 for each volume cell, times evaluations of the forces and\n"
        "products of an implicit method's solver; 2.2 times as much if steps split the dashpots off.\n"
        "Exits with 5 if the need cannot be met, and prints the smallest error.\n"
        "Examples:\n"
        "  taut plan drape\n"
        "  taut plan my.toml --json out/plan.json --write\n"
        "  taut plan flag --set need.rms_pixels=2 --set need.horizon_s=0.1 --effort 2");
    return [flags] { return plan(*flags); };
}

}  // namespace

Command planCommand() {
    return {"plan", "Find the cheapest settings that meet the need of a scene", declarePlan};
}

}  // namespace taut::game
