#include "game/renderers.h"

#include <cstdlib>

#include "game/folders.h"
#include "taut/pipeline/self_test.h"

namespace taut::game {

std::vector<render::Backend> backendsNamed(const std::string& gl) {
    std::vector<render::Backend> backends = {render::Backend::osmesa, render::Backend::egl};
    if (!gl.empty()) std::erase_if(backends, [&](render::Backend backend) { return pipeline::nameOf(backend) != gl; });
    return backends;
}

void limitSoftwareRenderer(int threads) {
    if (threads > 0) ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
}

std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads, const std::string& gl) {
    limitSoftwareRenderer(threads);
    render::RendererOptions options;
    options.width = picture.size.x;
    options.height = picture.size.y;
    options.samples = picture.samples;
    options.shadowSize = picture.shadowSize;
    options.shaders = shaderFolder();
    options.font = fontFile();
    return pipeline::workingRenderer(options, backendsNamed(gl));
}

}  // namespace taut::game
