#include "game/renderers.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <thread>

#include "game/command_line.h"
#include "game/folders.h"
#include "game/usage.h"
#include "taut/core/error.h"
#include "taut/core/numbers.h"
#include "taut/pipeline/self_test.h"
#include "taut/spec/picture_spec.h"

namespace taut::game {

GlChoice glNamed(const std::string& gl) {
    using render::Backend;
    if (gl.empty()) return {render::backends()};
    for (const Backend backend : {Backend::osmesa, Backend::egl})
        if (gl == pipeline::nameOf(backend)) return {{backend}};
    if (gl.starts_with("egl:"))
        if (const auto device = core::wholeIn<int>(gl.substr(4))) return {{Backend::egl}, device};
    failUsage("expected osmesa, egl, or egl:N with the number of a device that taut doctor names, not {}", gl);
}

void addRendererFlag(Options& options, std::string& gl) {
    options
        .value("--gl", gl,
               "Renderer: osmesa, egl (a graphics card if there is one), or egl:N, a device listed by taut doctor; "
               "default osmesa if it works")
        .typeName("NAME")
        .suggests({"osmesa", "egl"})
        .check([](const std::string& text) -> std::string {
            try {
                (void)glNamed(text);
            } catch (const core::Error& error) {
                return error.what();
            }
            return "";
        });
}

void limitSoftwareRenderer(int threads) {
    if (threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

namespace {

render::RendererOptions optionsFor(const world::PictureSpec& picture, const pipeline::PictureLayers& layers) {
    render::RendererOptions options;
    options.width = picture.size.x;
    options.height = picture.size.y;
    options.samples = picture.samples;
    options.shadowSize = picture.shadowSize;
    options.alpha = layers.alpha;
    options.layers = layers.layers;
    options.shaders = shaderFolder();
    options.font = fontFile();
    return options;
}

}  // namespace

std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads, const std::string& gl,
                                               const pipeline::PictureLayers& layers) {
    limitSoftwareRenderer(threads);
    const int processors = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    if (const std::string shortage = pipeline::memoryShortage(processors); !shortage.empty())
        throw core::Error(core::ErrorKind::noRenderer, "nothing here can draw: " + shortage);
    const GlChoice choice = glNamed(gl);
    render::RendererOptions options = optionsFor(picture, layers);
    options.device = choice.device;
    return pipeline::workingRenderer(options, choice.backends);
}

std::vector<std::unique_ptr<render::Renderer>> makeRenderers(const world::PictureSpec& picture, int threads,
                                                             const std::string& gl,
                                                             const pipeline::PictureLayers& layers, int count) {
    std::vector<std::unique_ptr<render::Renderer>> renderers;
    renderers.push_back(makeRenderer(picture, threads, gl, layers));
    // The others by the library and the device that have proved to work.
    const render::RendererInfo info = renderers.front()->info();
    render::RendererOptions options = optionsFor(picture, layers);
    options.backend = glNamed(info.backend).backends.front();
    options.device = info.device;
    for (int i = 1; i < count; ++i) renderers.push_back(std::make_unique<render::Renderer>(options));
    return renderers;
}

int drawersFor(int threads, const world::PictureSpec& picture, const pipeline::RunOptions& options) {
    constexpr int most = 4;  // the pixels of all are drawn by the same threads; more save their corners alone
    constexpr double bytesOfPixel = 100.0, bytesOfShadowTexel = 4.5, partOfMemory = 0.125;
    const std::int64_t pictures = options.lastFrame - options.firstFrame + 1;
    const int processors = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const double bytes =
        bytesOfPixel * picture.size.x * picture.size.y + bytesOfShadowTexel * picture.shadowSize * picture.shadowSize;
    const double memory =
        partOfMemory * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    const auto fitting = static_cast<std::int64_t>(std::clamp(memory / bytes, 1.0, 64.0));
    return static_cast<int>(std::min({std::int64_t{processors}, std::int64_t{most}, fitting, pictures}));
}

}  // namespace taut::game
