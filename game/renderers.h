// Renderers for the program's pictures: its shaders, its font, the backends that may draw.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/render/renderer.h"
#include "taut/world/spec.h"

namespace taut::game {

// All in the order of trying, or the one that --gl names.
std::vector<render::Backend> backendsNamed(const std::string& gl);

// How many threads the software renderer may use, unless the user's LP_NUM_THREADS says it; 0: as many as there are.
void limitSoftwareRenderer(int threads);

// Of the picture's size and quality. Throws core::Error(noRenderer).
std::unique_ptr<render::Renderer> makeRenderer(const world::PictureSpec& picture, int threads,
                                               const std::string& gl = {});

}  // namespace taut::game
