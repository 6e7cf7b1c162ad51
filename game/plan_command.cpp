#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/progress.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/machine.h"
#include "taut/scene/load.h"
#include "taut/scene/private/splice.h"
#include "taut/study/plan.h"
#include "taut/study/plan_changes.h"
#include "taut/study/plan_text.h"

namespace taut::game {
namespace {

struct PlanFlags {
    std::string scene, json;
    std::vector<std::string> overrides;
    double effort = 20.0;
    bool write = false, quiet = false;
};

study::Plan search(const world::SceneSpec& spec, const PlanFlags& flags, const std::atomic<bool>& stop) {
    LiveLine line(flags.quiet);
    const auto start = std::chrono::steady_clock::now();
    study::PlanSettings settings;
    settings.effort = 1e9 * flags.effort;
    settings.stop = &stop;
    settings.progress = [&](const study::StudyProgress& progress) {
        if (!line.isDue(progress.done >= 1.0)) return;
        const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double left = spent * (1.0 / std::max(progress.done, 0.02) - 1.0);
        line.show(
            fmt::format("plan {:3.0f} %  about {} left  {}", 100 * progress.done, clockText(left), progress.doing));
    };
    return study::makePlan(spec, settings);
}

// The scene file with the changes, whole or not at all.
void write(const std::filesystem::path& file, const std::string& text, const world::SceneSpec& spec,
           const study::Plan& plan) {
    if (plan.changes.empty()) return printResult("\n{}: nothing to write\n", file.string());
    const std::string changed = scene::spliced(text, plan.changes);
    const world::SceneSpec now = scene::loadSceneText(changed, file.string(), loadOptions()).spec;
    for (const scene::Change& change : study::planChanges(spec, now))  // what is like a body changes with it
        if (std::none_of(plan.changes.begin(), plan.changes.end(),
                         [&](const scene::Change& planned) { return planned.key == change.key; }))
            throw core::Error(core::ErrorKind::badContent,
                              fmt::format("{}: {} would change too, by its like; give it a value of its own first",
                                          file.string(), change.key));
    if (plan.unseen() > 0)
        printNote("warning: what happens between {:.3g} s and {:.3g} s was not looked at; look at the film\n",
                  plan.seconds, plan.runSeconds);
    replaceSceneFile(file, text, changed);
    printResult("\n{}: {} value{} written\n", file.string(), plan.changes.size(), plan.changes.size() == 1 ? "" : "s");
}

int plan(const PlanFlags& flags) {
    const std::filesystem::path file = sceneFile(flags.scene);
    const std::string text = core::fileContent(file);
    const world::SceneSpec spec = readScene(flags.scene, flags.overrides);
    if (flags.write) expectWritable(file, spec, flags.overrides);
    if (!flags.json.empty()) core::prepareFolderOf(flags.json);

    const Interruption interruption;
    study::Plan result;
    try {
        result = search(spec, flags, interruption.flag());
    } catch (const core::Error&) {
        if (const auto code = interruption.exitCode()) return static_cast<int>(*code);
        throw;
    }
    printResult("{}", study::planSummary(result));
    if (!flags.json.empty())
        core::writeWholeFile(flags.json, study::planJson(result, machineFacts(pipeline::machine())));
    if (!result.isMet()) {
        if (flags.write) printResult("\n{}: nothing is written, as the need is not met\n", file.string());
        return static_cast<int>(ExitCode::needNotMet);
    }
    if (flags.write) write(file, text, spec, result);
    return static_cast<int>(ExitCode::ok);
}

Action declarePlan(Options& options) {
    const auto flags = std::make_shared<PlanFlags>();
    options.value("SCENE", flags->scene, "A scene file, or a shipped scene; it says in [need] what it needs")
        .required();
    options.value("-o,--json", flags->json, "Everything that was found, as JSON").typeName("FILE");
    options.flag("--write", flags->write, "Write the changed values into the scene file; the rest of it stays");
    options
        .value("--effort", flags->effort,
               "What all runs together may cost, in 1e9 springs and points times evaluations: 1 takes about 5 s")
        .within(1e-3, 1e6, "times 1e9: 0.2 means 2e8")
        .showDefault();
    options.value("--set", flags->overrides, "Override a field of the scene; repeatable")
        .typeName("KEY=VALUE")
        .oneValue();
    options.flag("--quiet", flags->quiet, "No progress");
    options.footer(
        "The cost of a candidate is springs, points and 5 for each volume cell, times evaluations of the forces and\n"
        "products of an implicit method's solver; 2.2 times as much where steps split the dashpots off.\n"
        "Ends with 5 when the need cannot be met, and says how near it came.\n"
        "Examples:\n"
        "  taut plan drape\n"
        "  taut plan my.toml --json out/plan.json --write\n"
        "  taut plan flag --set need.rms_pixels=2 --set need.horizon_s=0.1 --effort 2");
    return [flags] { return plan(*flags); };
}

}  // namespace

Command planCommand() {
    return {"plan", "Find the cheapest way to compute a scene as well as it needs", declarePlan};
}

}  // namespace taut::game
