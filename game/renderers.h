// Renderers for the program's pictures: its shaders, its font, the backends that may draw.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/pipeline/run_record.h"
#include "taut/render/renderer.h"
#include "taut/world/spec.h"

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

}  // namespace taut::game
