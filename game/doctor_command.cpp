#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "taut/core/error.h"
#include "taut/core/instruction_set.h"
#include "taut/core/whole_file.h"
#include "taut/image/video_writer.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/self_test.h"
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

// Each backend draws a small test picture; true when at least one does.
bool printRenderers() {
    bool any = false;
    for (const auto backend : {render::Backend::osmesa, render::Backend::egl}) {
        render::RendererOptions options;
        options.width = 64;
        options.height = 64;
        options.shadowSize = 256;
        options.backend = backend;
        options.shaders = shaderFolder();
        std::string fact;
        try {
            render::Renderer renderer(options);
            pipeline::testRenderer(renderer);
            const render::RendererInfo info = renderer.info();
            fact = fmt::format("ok: {}, {}, OpenGL {}", info.vendor, info.renderer, info.version);
            any = true;
        } catch (const core::Error& error) {
            fact = fmt::format("FAILS: {}", error.what());
        }
        printFact(pipeline::nameOf(backend), fact);
    }
    return any;
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
