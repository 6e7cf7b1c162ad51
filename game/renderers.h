// Renderers for the program's pictures: its shaders, its font, the backends that may draw.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/pipeline/run_record.h"
#include "taut/render/renderer.h"

namespace taut::world {
struct PictureSpec;
}

namespace taut::game {

// What --gl names; all in the order of trying when it is empty.
struct GlChoice {
    std::vector<render::Backend> backends;
    std::optional<int> device{};  // of EGL
};
// "osmesa", "egl" or "egl:N"; throws core::Error(usage).
GlChoice glNamed(const std::string& gl);

class Options;

// --gl
void addRendererFlag(Options& options, std::string& gl);

// How many threads the software renderer may use, unless the user's LP_NUM_THREADS says it; 0: as many as there are.
void limitSoftwareRenderer(int threads);

// Of the picture's size and quality. Throws core::Error(noRenderer).
std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads,
                                               const std::string& gl = {}, const pipeline::PictureLayers& layers = {});

// Several that draw the same pictures.
std::vector<std::unique_ptr<render::Renderer>> makeRenderers(const world::PictureSpec& picture, int threads,
                                                             const std::string& gl,
                                                             const pipeline::PictureLayers& layers, int count);

// How many renderers pay: `wanted`, or where that is 0 one for each thread, at most four, and no more than there are
// pictures and than an eighth of the memory holds.
int drawersFor(int wanted, int threads, const world::PictureSpec& picture, const pipeline::RunOptions& options);

}  // namespace taut::game
