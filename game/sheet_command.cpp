#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "taut/core/error.h"
#include "game/commands.h"
#include "taut/image/png.h"
#include "taut/report/contact_sheet.h"

namespace taut::game {
namespace {

struct SheetFlags {
    std::string frames;
    std::string output;
    report::SheetLayout layout;
};

int sheet(const SheetFlags& flags) {
    const image::FramePattern pattern(flags.frames);
    const std::filesystem::path output = flags.output.empty() ? pattern.folder() / "sheet.png" : std::filesystem::path(flags.output);
    if (output.extension() != ".png")
        throw core::Error(core::ExitCode::usage,
                          fmt::format("{}: let the name of the sheet end in .png", output.string()));
    const image::Image picture = report::contactSheet(pattern, flags.layout);
    image::writePng(output, picture);
    fmt::print("{}: {}x{} pixels\n", output.string(), picture.width, picture.height);
    return static_cast<int>(core::ExitCode::ok);
}

}  // namespace

void addSheet(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<SheetFlags>();
    CLI::App* command = app.add_subcommand("sheet", "Put evenly spaced frames of a run into one picture");
    command->add_option("FRAMES", flags->frames, "The folder of the frames, or their names: out/frame_######.png")
        ->required();
    command->add_option("-o,--output", flags->output, "The PNG to write; sheet.png in that folder when left out");
    command->add_option("--pictures", flags->layout.pictures, "How many frames to show")
        ->check(CLI::Range(1, 400))
        ->capture_default_str();
    command->add_option("--columns", flags->layout.columns, "How many stand side by side")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command->add_option("--width", flags->layout.width, "Width of the sheet in pixels")
        ->check(CLI::Range(64, 16384))
        ->capture_default_str();
    command->callback([&chosen, flags] { chosen = [flags] { return sheet(*flags); }; });
}

}  // namespace taut::game
