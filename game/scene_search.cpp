#include "game/scene_search.h"

#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/core/whole_file.h"

namespace taut::game {

void addSearchFlags(Options& options, SearchFlags& flags, const std::string& says) {
    options.value("SCENE", flags.scene, says).required();
    options.value("-o,--json", flags.json, "File for all results, as JSON").typeName("FILE");
    options.flag("--write", flags.write, "Write the values into the scene file and keep the rest of it");
    addOverrideFlag(options, flags.overrides, "Override a field of the scene; repeatable");
    addThreadsFlag(options, flags.threads);
    options.flag("--quiet", flags.quiet, "Print no progress");
}

int searchScene(const SearchFlags& flags,
                const std::function<Found(const SearchedScene& scene, const std::atomic<bool>& stop)>& search) {
    const core::ThreadLimit limit(flags.threads);
    const std::filesystem::path file = sceneFile(flags.scene);
    const SearchedScene scene{file, core::fileContent(file), readScene(flags.scene, flags.overrides)};
    if (flags.write) expectWritable(file, scene.spec, flags.overrides);
    if (!flags.json.empty()) core::prepareFolderOf(flags.json);

    const Interruption interruption;
    Found found;
    try {
        found = search(scene, interruption.flag());
    } catch (const core::Error&) {
        if (const auto code = interruption.exitCode()) return static_cast<int>(*code);
        throw;
    }
    printResult("{}", found.summary);
    if (!flags.json.empty()) core::writeWholeFile(flags.json, found.json);
    if (flags.write && (!found.isMet || found.changes.empty())) {
        printResult("\n{}: nothing {} written\n", file.string(), found.isMet ? "has to be" : "is");
    } else if (flags.write) {
        const std::string changed = scene::spliced(scene.text, found.changes);
        if (found.beforeWriting) found.beforeWriting(changed);
        replaceSceneFile(file, scene.text, changed);
        printResult("\n{}: {} value{} written\n", file.string(), found.changes.size(),
                    found.changes.size() == 1 ? "" : "s");
    }
    return static_cast<int>(found.isMet ? ExitCode::ok : ExitCode::needNotMet);
}

}  // namespace taut::game
