#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/interruption.h"
#include "game/lab.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/machine.h"
#include "taut/scene/private/by_key.h"
#include "taut/scene/private/splice.h"
#include "taut/study/fit.h"
#include "taut/study/fit_text.h"

namespace taut::game {
namespace {

struct FitFlags {
    std::string scene, json;
    std::vector<std::string> overrides;
    int trials = 300;
    bool write = false, quiet = false;
};

study::Fit search(const std::filesystem::path& file, const std::string& text, const world::SceneSpec& spec,
                  const FitFlags& flags, const std::atomic<bool>& stop) {
    LiveLine line(flags.quiet);
    study::FitSettings settings;
    settings.most = flags.trials;
    settings.stop = &stop;
    // A trial is what --set makes of the file.
    settings.scene = [&](const std::vector<double>& values) {
        std::vector<std::string> overrides = flags.overrides;
        for (std::size_t i = 0; i < values.size(); ++i)
            overrides.push_back(spec.fit.keys[i] + "=" + scene::numberText(values[i]));
        return scene::loadSceneText(text, file.string(), loadOptions(overrides)).spec;
    };
    settings.progress = [&, best = HUGE_VAL](const study::FitTrial& trial, int number) mutable {
        best = std::min(best, trial.misfit);
        if (line.isDue(false)) line.show(fmt::format("fit {} trials, misfit {:.4g}", number, best));
    };
    return study::makeFit(spec, settings);
}

int fit(const FitFlags& flags) {
    const std::filesystem::path file = sceneFile(flags.scene);
    const std::string text = core::fileContent(file);
    const world::SceneSpec spec = readScene(flags.scene, flags.overrides);
    if (flags.write) expectWritable(file, spec, flags.overrides);
    if (!flags.json.empty()) core::prepareFolderOf(flags.json);

    const Interruption interruption;
    study::Fit result;
    try {
        result = search(file, text, spec, flags, interruption.flag());
    } catch (const core::Error&) {
        if (const auto code = interruption.exitCode()) return static_cast<int>(*code);
        throw;
    }
    printResult("{}", study::fitSummary(result));
    if (!flags.json.empty())
        core::writeWholeFile(flags.json, study::fitJson(result, machineFacts(pipeline::machine())));
    if (!result.isMet()) {
        if (flags.write) printResult("\n{}: nothing is written\n", file.string());
        return static_cast<int>(ExitCode::needNotMet);
    }
    if (flags.write) {
        replaceSceneFile(file, text, scene::spliced(text, result.changes));
        printResult("\n{}: {} value{} written\n", file.string(), result.changes.size(),
                    result.changes.size() == 1 ? "" : "s");
    }
    return static_cast<int>(ExitCode::ok);
}

Action declareFit(Options& options) {
    const auto flags = std::make_shared<FitFlags>();
    options.value("SCENE", flags->scene, "A scene file; it says in [fit] what to seek and what was measured")
        .required();
    options.value("-o,--json", flags->json, "Everything that was found, as JSON").typeName("FILE");
    options.flag("--write", flags->write, "Write the values found into the scene file; the rest of it stays");
    options.value("--trials", flags->trials, "Runs at most").within(1, 1000000).showDefault();
    options.value("--set", flags->overrides, "Override a field of the scene; repeatable")
        .typeName("KEY=VALUE")
        .oneValue();
    options.flag("--quiet", flags->quiet, "No progress");
    options.footer(
        "A trial is the scene with --set of its values, played to the last moment that was measured.\n"
        "Ends with 5 when a target cannot be met, or two numbers cannot be told apart, and says so.\n"
        "Examples:\n"
        "  taut fit strip.toml\n"
        "  taut fit strip.toml --json out/fit.json --write");
    return [flags] { return fit(*flags); };
}

}  // namespace

Command fitCommand() {
    return {"fit", "Find the numbers with which a scene does what was measured", declareFit};
}

}  // namespace taut::game
