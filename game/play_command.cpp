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
    std::string size, record, isa;
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
               "Size of the picture in pixels of a common screen; 512x288 when not given; the window can be drawn "
               "larger")
        .typeName("WxH");
    options
        .value(
            "--quality", settings.quality,
            "auto: as fine as 30 pictures a second let it be; draft: coarse shadows; normal: no anti-aliasing; full: "
            "as the scene has it")
        .oneOf({"auto", "draft", "normal", "full"})
        .showDefault();
    addRendererFlag(options, settings.gl);
    options.value("--seconds", settings.seconds, "End by itself after this time, and tell the pictures a second")
        .check(numberWithin(leastSeconds, mostSeconds));
    options.value("--record", flags->record, "Record from the start into this scenario file").typeName("FILE");
    options.flag("--watch", settings.watches,
                 "Read the scene again whenever one of its files is written: same camera, same moment; what is wrong "
                 "with it stands over the picture");
    addThreadsFlag(options, settings.threads);
    addInstructionSetFlag(options, flags->isa);
    addOverrideFlag(options, settings.overrides);
    const Option quiet = options.flag("--quiet", settings.isQuiet, "Warnings and errors only");
    options.flag("--verbose", settings.isVerbose, "Print every action as it is done").excludes(quiet);
    options.footer(
        "In the window h shows the keys. R records: the session becomes a scenario file, which\n"
        "taut render and taut test play again to the same state. The hand pulls with twice the weight\n"
        "of what hangs together at most, and slips from what that does not move.\n"
        "Examples:\n"
        "  taut play curtain\n"
        "  taut play my.toml --watch\n"
        "  taut play flag --size 1280x720 --quality full --record pulled.toml");
    return [flags] { return play(*flags); };
}

}  // namespace

Command playCommand() {
    return {"play", "Play a scene in a window: pull, look around, record", declarePlay};
}

}  // namespace taut::game
