#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "taut/core/error.h"
#include "taut/core/instruction_set.h"
#include "taut/core/whole_file.h"
#include "taut/image/compare.h"
#include "taut/image/video_writer.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/self_test.h"
#include "taut/render/egl_devices.h"
#include "taut/render/font.h"
#include "taut/report/gnuplot.h"

namespace taut::game {
namespace {

void printFact(const std::string& name, const std::string& fact) {
    printResult("{:<12}{}\n", name, fact);
}

void printMachine() {
    const pipeline::Machine machine = pipeline::machine();
    printFact("program", fmt::format("{}, {}", machine.program, machine.compiler));
    printFact("system", machine.system);
    printFact("processor",
              fmt::format("{}, {} threads, {:.1f} GB", machine.processor, machine.threads, machine.memory / 1e9));
    std::string sets;
    for (const auto set : {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512})
        if (core::isSupported(set)) sets += fmt::format("{} ", core::nameOf(set));
    printFact("simd", fmt::format("{}(in use: {}; {})", sets, machine.simd, machine.simdReason));
}

// Whether the folder is there; the program cannot do without its shaders.
bool printFolder(const std::string& name, const std::filesystem::path& folder, const char* variable) {
    printFact(name, folder.empty() ? fmt::format("MISSING; {} may name the folder", variable) : folder.string());
    return !folder.empty();
}

// Only scenes with labels need it, so nothing fails without it.
void printFont() {
    const std::filesystem::path file = fontFile();
    try {
        const render::Font font(file);
        printFact("font", file.string());
    } catch (const core::Error& error) {
        printFact("font", fmt::format("MISSING: {}", error.what()));
    }
}

// Tells how one draws a picture of the usual size; the picture, empty where it draws none. `right` is OSMesa's.
image::Image printRenderer(const std::string& name, render::Backend backend, std::optional<int> device,
                           const image::Image& right, const std::string& kind = "") {
    constexpr int pictures = 5;
    render::RendererOptions options;
    options.backend = backend;
    options.device = device;
    options.shaders = shaderFolder();
    try {
        render::Renderer renderer(options);
        pipeline::testRenderer(renderer);
        pipeline::TestDrawing drawing = pipeline::drawTest(renderer, pictures);
        const render::RendererInfo info = renderer.info();
        std::string fact =
            fmt::format("{}ok: {}, {}, OpenGL {}; {:.3g} ms for a picture of {}x{}", kind, info.vendor, info.renderer,
                        info.version, 1e3 * drawing.seconds, options.width, options.height);
        if (right.isWhole()) {
            const image::Comparison comparison = image::compare(right, drawing.picture);
            fact += comparison.largest == 0
                        ? "; the same pixels as OSMesa"
                        : fmt::format("; from OSMesa's pixels off by up to {}/255, {:.3g} on average",
                                      comparison.largest, comparison.mean);
        }
        printFact(name, fact);
        return drawing.picture;
    } catch (const core::Error& error) {
        printFact(name, fmt::format("{}FAILS: {}", kind, error.what()));
        return {};
    }
}

// True when at least one draws.
bool printRenderers() {
    const image::Image right = printRenderer("osmesa", render::Backend::osmesa, std::nullopt, {});
    bool any = right.isWhole();
    const std::vector<render::EglDevice> devices = render::eglDevices();
    for (const render::EglDevice& device : devices) {
        const std::string name = fmt::format("egl:{}", device.number);
        const std::string kind = fmt::format("{}, ", render::kindOf(device));
        any = printRenderer(name, render::Backend::egl, device.number, right, kind).isWhole() || any;
    }
    if (!devices.empty()) return any;
    const std::string none = "no device here; without one ";
    return printRenderer("egl", render::Backend::egl, std::nullopt, right, none).isWhole() || any;
}

bool printWriteTest(const std::filesystem::path& folder) {
    try {
        const std::filesystem::path file = folder / "taut-write-test";
        core::writeWholeFile(file, "taut\n");
        std::filesystem::remove(file);
        printFact("write test", fmt::format("ok: {}", std::filesystem::absolute(folder).lexically_normal().string()));
        return true;
    } catch (const core::Error& error) {
        printFact("write test", fmt::format("FAILS: {}", error.what()));
        return false;
    }
}

int doctor(const std::string& folder) {
    printMachine();
    const std::string ffmpeg = image::ffmpegVersion();
    printFact("ffmpeg", ffmpeg.empty() ? "MISSING: videos need the package ffmpeg, picture files do not" : ffmpeg);
    const std::string gnuplot = report::gnuplotVersion();
    printFact("gnuplot",
              gnuplot.empty() ? "MISSING: charts need the package gnuplot-nox, their CSV does not" : gnuplot);
    bool files = printFolder("shaders", shaderFolder(), "TAUT_SHADERS");
    files = printFolder("assets", assetFolder(), "TAUT_ASSETS") && files;
    printFont();
    printFact("scenes", fmt::format("{}", fmt::join(shippedScenes(), " ")));
    const bool draws = printRenderers();
    files = printWriteTest(folder) && files;
    const ExitCode code = !files ? ExitCode::inputOutput : !draws ? ExitCode::noRenderer : ExitCode::ok;
    printResult("{}\n", code == ExitCode::ok ? "Everything needed is there." : "Something is missing.");
    return static_cast<int>(code);
}

Action declareDoctor(Options& options) {
    const auto folder = std::make_shared<std::string>(".");
    options.value("-o,--output", *folder, "The folder for the write test").typeName("FOLDER");
    return [folder] { return doctor(*folder); };
}

}  // namespace

Command doctorCommand() {
    return {"doctor", "Tell what is installed and whether drawing and writing work", declareDoctor};
}

}  // namespace taut::game
