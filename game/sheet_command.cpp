
#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/messages.h"
#include "game/usage.h"
#include "taut/image/png.h"
#include "taut/pipeline/run_parts.h"
#include "taut/report/contact_sheet.h"

namespace taut::game {
namespace {

struct SheetFlags {
    std::string frames;
    std::string output;
    report::SheetLayout layout;
};

// Of a folder the names that the run's record tells, if it has one.
image::FramePattern patternOf(const std::filesystem::path& frames) {
    if (frames.extension() == ".png") return image::FramePattern(frames);
    if (frames.extension() == ".toml")
        failUsage("{0} is a scene: taut render {0} -o out/ makes frames of it, and then taut sheet out/ the sheet",
                  frames.string());
    const std::vector<std::string> names = pipeline::recordedFiles(frames);
    return image::FramePattern(names.size() == 1 ? frames / names.front() : frames);
}

int sheet(const SheetFlags& flags) {
    const image::FramePattern pattern = patternOf(flags.frames);
    const std::filesystem::path output =
        flags.output.empty() ? pattern.folder() / "sheet.png" : std::filesystem::path(flags.output);
    if (output.extension() != ".png") failUsage("{}: the name of the sheet must end in .png", output.string());
    const image::Image picture = report::contactSheet(pattern, flags.layout);
    image::writePng(output, picture);
    printResult("{}: {}x{} pixels\n", output.string(), picture.width, picture.height);
    return static_cast<int>(ExitCode::ok);
}

Action declareSheet(Options& options) {
    const auto flags = std::make_shared<SheetFlags>();
    options.value("FRAMES", flags->frames, "Folder of the frames, or their names: out/p_######.png").required();
    options.value("-o,--output", flags->output, "PNG to write; default sheet.png in that folder");
    options.value("--pictures", flags->layout.pictures, "Number of frames").within(1, 400).showDefault();
    options.value("--columns", flags->layout.columns, "Number of columns").within(1, 100).showDefault();
    options.value("--width", flags->layout.width, "Width of the sheet in pixels").within(64, 16384).showDefault();
    return [flags] { return sheet(*flags); };
}

}  // namespace

Command sheetCommand() {
    return {"sheet", "Put evenly spaced frames of a run into one picture", declareSheet};
}

}  // namespace taut::game
