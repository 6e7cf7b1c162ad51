// Makes a renderer and makes sure that it draws. It knows no scenes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/render/renderer.h"

namespace taut::pipeline {

// Draws one triangle and looks at the pixels. Throws core::Error(noRenderer) when the picture is blank or wrong, with
// the strings of the driver.
void testRenderer(render::Renderer& renderer);

// The first of the backends that gives a context and passes the test. Throws core::Error(noRenderer) that tells for
// each what happened. Expects at least one backend; options.backend is not used.
std::unique_ptr<render::Renderer> workingRenderer(render::RendererOptions options,
                                                  const std::vector<render::Backend>& backends);

std::string nameOf(render::Backend backend);  // as in the flag --gl

}  // namespace taut::pipeline
