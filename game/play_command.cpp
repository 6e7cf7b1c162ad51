#include <fmt/format.h>

#include <memory>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/flags.h"
#include "game/interruption.h"
#include "game/live_play.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"

namespace taut::game {
namespace {

struct PlayFlags {
    PlaySettings settings;
    std::string size, record;
};

int play(const PlayFlags& flags) {
    PlaySettings settings = flags.settings;
    if (!flags.size.empty()) {
        const Size size = pictureSize(flags.size);
        settings.width = size.width;
        settings.height = size.height;
    }
    settings.records = !flags.record.empty();
    settings.record = flags.record;
    if (settings.records && settings.record.extension() != ".toml") failUsage("--record: the name must end in .toml");
    const Interruption interruption;
    const core::ThreadLimit threads(settings.threads);
    std::unique_ptr<LivePlay> live;
    try {
        live = std::make_unique<LivePlay>(settings);
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::noRenderer) throw;
        throw core::Error(core::ErrorKind::noRenderer, fmt::format("{}.\nWithout a window: taut render {} -o play.mp4",
                                                                   error.what(), settings.scene));
    }
    live->run(interruption.flag());
    return static_cast<int>(interruption.exitCode().value_or(ExitCode::ok));
}

Action declarePlay(Options& options) {
    const auto flags = std::make_shared<PlayFlags>();
    PlaySettings& settings = flags->settings;
    options.value("SCENE", settings.scene, "A scene file, or the name of a shipped scene").required();
    options
        .value("--size", flags->size,
               "Size of the picture in pixels; default 512x288 for a common screen; the window can be enlarged")
        .typeName("WxH");
    options
        .value("--quality", settings.quality,
               "auto: adapts to 30 pictures a second; draft: coarse shadows; normal: no anti-aliasing; full: as in the "
               "scene")
        .oneOf({"auto", "draft", "normal", "full"})
        .showDefault();
    addRendererFlag(options, settings.gl);
    options.value("--seconds", settings.seconds, "Quit after this time and print the pictures per second")
        .check(numberWithin(leastSeconds, mostSeconds));
    options.value("--record", flags->record, "Record from the start into this scenario file").typeName("FILE");
    options.flag("--watch", settings.watches,
                 "Reload the scene when one of its files is written, with the same camera and time; errors are shown "
                 "over the picture");
    addThreadsFlag(options, settings.threads);
    addOverrideFlag(options, settings.overrides);
    const Option quiet = options.flag("--quiet", settings.isQuiet, "Print only warnings and errors");
    options.flag("--verbose", settings.isVerbose, "Print every action").excludes(quiet);
    options.footer(
        "In the window h shows the keys. R records a scenario file, which taut render and taut test play again to the\n"
        "same state. The hand pulls with at most twice the weight of the connected bodies, and slips from heavier "
        "ones.\n"
        "Examples:\n"
        "  taut play curtain\n"
        "  taut play my.toml --watch\n"
        "  taut play flag --size 1280x720 --quality full --record pulled.toml");
    return [flags] { return play(*flags); };
}

}  // namespace

Command playCommand() {
    return {"play", "Play a scene in a window and record actions", declarePlay};
}

}  // namespace taut::game
