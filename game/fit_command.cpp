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
    // A trial is what --set makes of the file.
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
    addSearchFlags(options, *flags, "A scene file; it says in [fit] what to seek and what was measured");
    options.value("--trials", flags->trials, "Runs at most").within(1, 1000000).showDefault();
    options.footer(
        "A trial is the scene with --set of its values, played to the last moment that was measured.\n"
        "Starts from the scene's values; while a target is not met, from other places between the bounds.\n"
        "Ends with 5 when a target is not met, or two numbers cannot be told apart, and says so.\n"
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
