#include "game/calibration_run.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "taut/core/error.h"
#include "game/lab.h"
#include "game/shell_word.h"
#include "taut/image/frame_sequence.h"
#include "taut/core/whole_file.h"

namespace taut::game {
namespace {

// Draws a golden picture in a process of its own, where the software renderer has so many threads.
std::string drawApart(const std::string& gl, const regression::Scenario& scenario,
                      const regression::GoldenRequest& golden, int threads, const std::filesystem::path& png) {
    const std::filesystem::path frames = png.parent_path() / (png.stem().string() + "_######.png");
    std::string command = fmt::format(
        "exec env -u LP_NUM_THREADS {} render {} -o {} --frames {} --size {}x{} --threads {} --hash --quiet -y{}{}{}",
        shellWord(std::filesystem::read_symlink("/proc/self/exe").string()), shellWord(scenario.file.string()),
        shellWord(frames.string()), golden.frame, golden.size.x, golden.size.y, threads, golden.debug ? " --debug" : "",
        golden.camera.empty() ? "" : " --camera " + shellWord(golden.camera), gl.empty() ? "" : " --gl " + gl);
    const std::filesystem::path complaints = png.parent_path() / "said.txt";  // warnings, known from elsewhere
    command += " 2>" + shellWord(complaints.string());
    FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 256> text{};
    std::string said;
    while (pipe != nullptr && std::fgets(text.data(), text.size(), pipe) != nullptr) said += text.data();
    if (pipe == nullptr || ::pclose(pipe) != 0)
        throw core::Error(core::ExitCode::inputOutput,
                          fmt::format("this failed: {}\n{}", command, core::fileContent(complaints)));
    std::filesystem::rename(image::FramePattern(frames).pathOf(golden.frame), png);
    const std::size_t space = said.find(' ');
    return space == std::string::npos ? "" : said.substr(space + 1, 16);
}

// A folder that goes with everything in it.
class Scratch {
  public:
    Scratch() : path_((std::filesystem::temp_directory_path() / "taut-calibrate-XXXXXX").string()) {
        if (::mkdtemp(path_.data()) == nullptr)
            throw core::Error(core::ExitCode::inputOutput, fmt::format("{}: cannot make a folder there", path_));
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
    options.drawApart = [&](const auto& scenario, const auto& golden, int threads, const auto& png) {
        return drawApart(request.gl, scenario, golden, threads, png);
    };
    options.progress = [&](double done, const std::string& doing) { progress.show(done, doing); };
    return regression::calibrate(request.scenarios, options, stop);
}

}  // namespace taut::game
