#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/exit_code.h"
#include "game/folders.h"
#include "game/messages.h"
#include "game/version.h"
#include "game/web_page.h"
#include "game/window.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/instruction_set.h"
#include "taut/core/whole_file.h"
#include "taut/image/private/compare.h"
#include "taut/image/private/video_writer.h"
#include "taut/pipeline/machine.h"
#include "taut/pipeline/self_test.h"
#include "taut/render/private/egl_devices.h"
#include "taut/render/private/font.h"
#include "taut/report/gnuplot.h"

namespace taut::game {
namespace {

void printFact(const std::string& name, const std::string& fact) {
    printResult("{:<12}{}\n", name, fact);
}

// Missing parts, by their Debian packages.
struct Packages {
    std::vector<std::string> names;
    void add(const std::string& name) {
        if (!core::contains(names, name)) names.push_back(name);
    }
};

// `loss`: the functions that need it.
void printMissing(const std::string& name, const std::string& loss, const std::string& package, Packages& packages) {
    printFact(name, fmt::format("MISSING: {}; it is in the package {}", loss, package));
    packages.add(package);
}

void printMachine() {
    const pipeline::Machine machine = pipeline::machine();
    printFact("program", fmt::format("{}, {}", versionText(), machine.compiler));
    printFact("system", machine.system);
    printFact("processor",
              fmt::format("{}, {} threads, {:.1f} GB", machine.processor, machine.threads, machine.memory / 1e9));
    std::string sets;
    for (const auto set : {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512})
        if (core::isSupported(set)) sets += fmt::format("{} ", core::nameOf(set));
    printFact("simd", fmt::format("{}(in use: {}; {})", sets, machine.simd, machine.simdReason));
}

void printTool(const std::string& name, const std::string& version, const std::string& loss, const std::string& package,
               Packages& packages) {
    if (version.empty())
        printMissing(name, loss, package, packages);
    else
        printFact(name, version);
}

// Whether the folder is there.
bool printFolder(const std::string& name, std::filesystem::path (*find)(), const std::string& loss,
                 const char* variable) try {
    const std::filesystem::path folder = find();
    printFact(name, folder.empty()
                        ? fmt::format("MISSING: {}; it is in the package taut, and {} may name another", loss, variable)
                        : folder.string());
    return !folder.empty();
} catch (const core::Error& error) {
    printFact(name, fmt::format("MISSING: {}: {}", loss, error.what()));
    return false;
}

void printFont(Packages& packages) {
    const std::filesystem::path file = fontFile();
    try {
        const render::Font font(file);
        printFact("font", file.string());
    } catch (const core::Error& error) {
        printFact("font", fmt::format("MISSING: no labels in scenes and no figures over pictures: {}", error.what()));
        packages.add("fonts-dejavu-core");
    }
}

void printViewer(Packages& packages) {
    try {
        printTool("three.js", viewerLibrary().string(), "no pages by taut export --web", "libjs-three", packages);
    } catch (const core::Error& error) {
        printFact("three.js", fmt::format("MISSING: no pages by taut export --web; TAUT_THREE: {}", error.what()));
    }
}

void printWindow() {
    try {
        printFact("window", fmt::format("ok: {}", windowDriver()));
    } catch (const core::Error& error) {
        printFact("window", fmt::format("MISSING: no taut play, for {}; all other commands work. Without a screen "
                                        "xvfb-run provides a display; it is in the package xvfb",
                                        error.what()));
    }
}

// Tells how one draws a picture of the usual size; the picture, empty where it draws none. `right` is OSMesa's.
image::Image printRenderer(const std::string& name, render::Backend backend, std::optional<int> device,
                           const image::Image& right, const std::string& kind = "") {
    constexpr int pictures = 5;
    render::RendererOptions options;
    options.backend = backend;
    options.device = device;
    try {
        options.shaders = shaderFolder();
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
                        : fmt::format("; pixels differ from OSMesa's by up to {}/255, {:.3g} on average",
                                      comparison.largest, comparison.mean);
        }
        printFact(name, fact);
        return drawing.picture;
    } catch (const core::Error& error) {
        printFact(name, fmt::format("{}FAILS: {}", kind, error.what()));
        return {};
    }
}

// Whether EGL draws on any of its devices, or without one.
bool printEgl(const image::Image& right) {
    const std::vector<render::EglDevice> devices = render::eglDevices();
    bool any = false;
    for (const render::EglDevice& device : devices) {
        const std::string name = fmt::format("egl:{}", device.number);
        const std::string kind = fmt::format("{}, ", render::kindOf(device));
        any = printRenderer(name, render::Backend::egl, device.number, right, kind).isWhole() || any;
    }
    if (!devices.empty()) return any;
    const std::string none = "no device here; without one ";
    return printRenderer("egl", render::Backend::egl, std::nullopt, right, none).isWhole();
}

// Whether anything draws.
bool printRenderers(Packages& packages) {
    const bool hasOsmesa = render::backends().front() == render::Backend::osmesa;
    if (!hasOsmesa) printFact("osmesa", "not in this build: OSMesa was not found; EGL is the default");
    const image::Image right =
        hasOsmesa ? printRenderer("osmesa", render::Backend::osmesa, std::nullopt, {}) : image::Image{};
    const bool draws = printEgl(right);
    const std::string shortage = draws || right.isWhole() ? "" : pipeline::memoryShortage();
    if (!shortage.empty()) {
        printFact("pictures", "MISSING: " + shortage);
        return false;
    }
    if (!draws)
        for (const char* package : {"libegl-mesa0", "libgl1-mesa-dri"}) packages.add(package);
    if (hasOsmesa && !right.isWhole()) packages.add("libosmesa6");
    if (!draws && right.isWhole()) printFact("--gl egl", "MISSING: no graphics card; drawing in software works");
    if (draws || right.isWhole()) return true;
    printFact("pictures", "MISSING: none without osmesa or egl; taut render --no-pictures needs neither");
    return false;
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
    Packages packages;
    printMachine();
    printTool("ffmpeg", image::ffmpegVersion(), "no videos; picture files need none", "ffmpeg", packages);
    printTool("gnuplot", report::gnuplotVersion(), "no charts and maps; their CSV and JSON need none", "gnuplot-nox",
              packages);
    printViewer(packages);
    bool files = printFolder("shaders", shaderFolder, "no pictures", "TAUT_SHADERS");
    const bool hasAssets = printFolder("assets", assetFolder, "no scene by its name", "TAUT_ASSETS");
    files = files && hasAssets;
    printFont(packages);
    printWindow();
    if (hasAssets) printFact("scenes", fmt::format("{}", fmt::join(shippedScenes(), " ")));
    const bool draws = printRenderers(packages);
    files = printWriteTest(folder) && files;
    const ExitCode code = !files ? ExitCode::inputOutput : !draws ? ExitCode::noRenderer : ExitCode::ok;
    printResult("{}\n", code == ExitCode::ok ? "All packages are installed." : "Packages are missing.");
    if (!packages.names.empty())
        printResult("To install them on Debian: apt install {}\n", fmt::join(packages.names, " "));
    return static_cast<int>(code);
}

Action declareDoctor(Options& options) {
    const auto folder = std::make_shared<std::string>(".");
    options.value("-o,--output", *folder, "Folder for the write test").typeName("FOLDER");
    return [folder] { return doctor(*folder); };
}

}  // namespace

Command doctorCommand() {
    return {"doctor", "Check packages, drawing and writing", declareDoctor};
}

}  // namespace taut::game
