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

// The same triangle over a ground that it darkens, to hold renderers against each other.
struct TestDrawing {
    image::Image picture;
    double seconds = 0.0;  // [s] of wall time a picture, the median
};
// Expects times >= 1; a first picture, for which the programs are made ready, does not count.
TestDrawing drawTest(render::Renderer& renderer, int times);

// The first of the backends that gives a context and passes the test. Throws core::Error(noRenderer) that tells for
// each what happened. Expects at least one backend; options.backend is not used.
std::unique_ptr<render::Renderer> workingRenderer(render::RendererOptions options,
                                                  const std::vector<render::Backend>& backends);

std::string nameOf(render::Backend backend);  // as in the flag --gl

}  // namespace taut::pipeline
