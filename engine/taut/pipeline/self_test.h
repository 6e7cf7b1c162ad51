// Makes a renderer and checks that it draws. It knows no scenes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "taut/render/renderer.h"

namespace taut::pipeline {

// Draws one triangle and checks the pixels. If the picture is blank or wrong, it throws core::Error(noRenderer) with
// the strings of the driver.
void testRenderer(render::Renderer& renderer);

// The same triangle over a ground that it shades, to compare renderers.
struct TestDrawing {
    image::Image picture;
    double seconds = 0.0;  // [s] of wall time a picture, the median
};
// Expects times >= 1. One more picture comes first and does not count: it prepares the programs.
TestDrawing drawTest(render::Renderer& renderer, int times);

// A renderer of the first backend that gives a context and passes the test. If none does, it throws
// core::Error(noRenderer) with the reason of each. Expects at least one backend; options.backend is not used.
std::unique_ptr<render::Renderer> workingRenderer(render::RendererOptions options,
                                                  const std::vector<render::Backend>& backends);

// Why nothing draws if this process may not have the addresses that a software renderer with that number of threads
// takes; empty: it may. To be asked first: libraries of OpenGL crash where they get none.
std::string memoryShortage(int threads = 1);

std::string nameOf(render::Backend backend);  // as in the flag --gl

}  // namespace taut::pipeline
