#include "game/renderers.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "game/command_line.h"
#include "game/folders.h"
#include "taut/core/error.h"
#include "taut/pipeline/self_test.h"

namespace taut::game {

GlChoice glNamed(const std::string& gl) {
    using render::Backend;
    if (gl.empty()) return {{Backend::osmesa, Backend::egl}};
    for (const Backend backend : {Backend::osmesa, Backend::egl})
        if (gl == pipeline::nameOf(backend)) return {{backend}};
    const std::string_view view = gl;
    if (view.starts_with("egl:")) {
        int device = 0;
        const auto [end, error] = std::from_chars(view.data() + 4, view.data() + view.size(), device);
        if (error == std::errc() && end == view.data() + view.size() && device >= 0) return {{Backend::egl}, device};
    }
    throw core::Error(core::ErrorKind::usage,
                      fmt::format("expected osmesa, egl, or egl:N with the number of a device that taut doctor names, "
                                  "not {}",
                                  gl));
}

void addRendererFlag(Options& options, std::string& gl) {
    options
        .value("--gl", gl,
               "What draws: osmesa, egl, which takes a graphics card where there is one, or egl:N, a device that taut "
               "doctor names; osmesa, if it works, when not given")
        .typeName("NAME")
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

std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads, const std::string& gl,
                                               const pipeline::PictureLayers& layers) {
    limitSoftwareRenderer(threads);
    render::RendererOptions options;
    options.width = picture.size.x;
    options.height = picture.size.y;
    options.samples = picture.samples;
    options.shadowSize = picture.shadowSize;
    options.alpha = layers.alpha;
    options.depthUnit = layers.depthUnit;
    options.maskColours = layers.maskColours;
    options.shaders = shaderFolder();
    options.font = fontFile();
    const GlChoice choice = glNamed(gl);
    options.device = choice.device;
    return pipeline::workingRenderer(options, choice.backends);
}

}  // namespace taut::game
