#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/lab.h"
#include "game/live_line.h"
#include "game/scene_file.h"
#include "game/scene_search.h"
#include "taut/pipeline/machine.h"
#include "taut/scene/load.h"
#include "taut/scene/private/by_key.h"
#include "taut/study/fit.h"
#include "taut/study/fit_text.h"

namespace taut::game {
namespace {

struct FitFlags : SearchFlags {
    int trials = 300;
};

study::Fit search(const SearchedScene& scene, const FitFlags& flags, const std::atomic<bool>& stop) {
    LiveLine line(flags.quiet);
    study::FitSettings settings;
    settings.most = flags.trials;
    settings.stop = &stop;
    // A trial is the file with --set of its values.
    settings.scene = [&](const std::vector<double>& values) {
        std::vector<std::string> overrides = flags.overrides;
        for (std::size_t i = 0; i < values.size(); ++i)
            overrides.push_back(scene.spec.fit.keys[i] + "=" + scene::numberText(values[i]));
        return scene::loadSceneText(scene.text, scene.file.string(), loadOptions(overrides)).spec;
    };
    settings.progress = [&, best = HUGE_VAL](const study::FitTrial& trial, int number) mutable {
        best = std::min(best, trial.misfit);
        if (line.isDue(false)) line.show(fmt::format("fit {} trials, misfit {:.4g}", number, best));
    };
    return study::makeFit(scene.spec, settings);
}

int fit(const FitFlags& flags) {
    return searchScene(
        flags,
        [&](const SearchedScene& scene, const std::atomic<bool>& stop) {
            const study::Fit fit = search(scene, flags, stop);
            return Found{study::fitSummary(fit),
                         study::fitJson(fit, machineFacts(pipeline::machine())),
                         fit.isMet(),
                         fit.changes,
                         {}};
        });
}

Action declareFit(Options& options) {
    const auto flags = std::make_shared<FitFlags>();
    addSearchFlags(options, *flags, "A scene file with [fit]: the numbers to fit and the measurements");
    options.value("--trials", flags->trials, "Largest number of runs").within(1, 1000000).showDefault();
    options.footer(
        "A trial is the scene with --set of its values, played to the last measured time. Starts from the values of "
        "the\n"
        "scene; if a target is not met, from other points between the bounds. Exits with 5 if a target is not met or "
        "two\n"
        "numbers cannot be told apart.\n"
        "Examples:\n"
        "  taut fit strip.toml\n"
        "  taut fit strip.toml --json out/fit.json --write");
    return [flags] { return fit(*flags); };
}

}  // namespace

Command fitCommand() {
    return {"fit", "Fit numbers of a scene to measurements", declareFit};
}

}  // namespace taut::game
