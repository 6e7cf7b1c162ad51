#include "game/calibration_run.h"

#include <fmt/format.h>

#include <chrono>

#include <cstdlib>
#include <filesystem>

#include "game/lab.h"
#include "taut/core/error.h"
#include "taut/core/private/child_process.h"
#include "taut/image/frame_sequence.h"

namespace taut::game {
namespace {

// Draws a golden picture in a process of its own; empty when it was stopped.
std::string drawApart(const std::string& gl, const regression::Scenario& scenario,
                      const regression::GoldenRequest& golden, const regression::Apart& how,
                      const std::filesystem::path& png, const std::atomic<bool>& stop) {
    const std::filesystem::path frames = png.parent_path() / (png.stem().string() + "_######.png");
    core::ChildCommand command;
    command.arguments = {std::filesystem::read_symlink("/proc/self/exe").string(),
                         "render",
                         scenario.file.string(),
                         "-o",
                         frames.string(),
                         "--frames",
                         std::to_string(golden.frame),
                         "--size",
                         fmt::format("{}x{}", golden.size.x, golden.size.y),
                         "--threads",
                         std::to_string(how.threads),
                         "--hash",
                         "--quiet",
                         "-y"};
    if (golden.debug) command.arguments.emplace_back("--debug");
    if (!golden.camera.empty()) command.arguments.insert(command.arguments.end(), {"--camera", golden.camera});
    if (!gl.empty()) command.arguments.insert(command.arguments.end(), {"--gl", gl});
    // How many threads the renderer may use, and for which processor it compiles.
    command.environment["LP_NUM_THREADS"] = std::nullopt;
    if (!how.processor.empty()) command.environment["GALLIUM_OVERRIDE_CPU_CAPS"] = how.processor;
    command.patience = std::chrono::hours(24);  // a scene may take long, and `stop` ends it
    const core::ChildResult result = core::runChild(command, {}, &stop);
    if (stop) return "";
    if (!result.end.succeeded())
        throw core::Error(core::ErrorKind::inputOutput, fmt::format("{} {}:\n{}", fmt::join(command.arguments, " "),
                                                                    result.end.text(), result.errors));
    std::filesystem::rename(image::FramePattern(frames).pathOf(golden.frame), png);
    const std::size_t space = result.output.find(' ');
    return space == std::string::npos ? "" : result.output.substr(space + 1, 16);
}

// A folder that goes with everything in it.
class Scratch {
  public:
    Scratch() : path_((std::filesystem::temp_directory_path() / "taut-calibrate-XXXXXX").string()) {
        if (::mkdtemp(path_.data()) == nullptr)
            throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: cannot make a folder there", path_));
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    std::filesystem::path path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace

std::vector<report::CalibrationRow> runCalibration(const CalibrationRequest& request, const std::atomic<bool>& stop) {
    const Scratch scratch;
    LabProgress progress("calibrate", request.quiet, stop);
    regression::CalibrationOptions options;
    options.drawing = request.drawing;
    options.tolerance = request.tolerance;
    options.scratch = scratch.path();
    options.drawApart = [&](const auto& scenario, const auto& golden, const auto& how, const auto& png) {
        return drawApart(request.gl, scenario, golden, how, png, stop);
    };
    options.progress = [&](double done, const std::string& doing) { progress.show(done, doing); };
    return regression::calibrate(request.scenarios, options, stop);
}

}  // namespace taut::game
