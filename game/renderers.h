// Makes renderers for the program's pictures: its shaders, its font, the allowed backends.
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

// The choice of --gl. Empty: all backends, in the order of trying.
struct GlChoice {
    std::vector<render::Backend> backends;
    std::optional<int> device{};  // of EGL
};
// "osmesa", "egl" or "egl:N"; throws core::Error(usage).
GlChoice glNamed(const std::string& gl);

class Options;

// --gl
void addRendererFlag(Options& options, std::string& gl);

// How many threads the software renderer may use, unless the user sets LP_NUM_THREADS; 0: as many as the machine has.
void limitSoftwareRenderer(int threads);

// With the picture's size and quality. Throws core::Error(noRenderer).
std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads,
                                               const std::string& gl = {}, const pipeline::PictureLayers& layers = {});

// Several renderers that draw the same pictures.
std::vector<std::unique_ptr<render::Renderer>> makeRenderers(const world::PictureSpec& picture, int threads,
                                                             const std::string& gl,
                                                             const pipeline::PictureLayers& layers, int count);

// A useful number of renderers: one for each thread, at most four, the number of pictures, and as many as fit in an
// eighth of the memory.
int drawersFor(int threads, const world::PictureSpec& picture, const pipeline::RunOptions& options);

}  // namespace taut::game
