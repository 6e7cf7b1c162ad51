// A picture of a scene: own_picture [SCENE.toml [PICTURE.png]]. Without a scene it draws a cloth that falls over a
// ball.
#include <cstdio>

#include "taut/core/error.h"
#include "taut/image/png.h"
#include "taut/render/renderer.h"
#include "taut/scene/load.h"
#include "taut/world/world.h"

using namespace taut;

constexpr const char* fallingCloth = R"(
schema = 1

[material.silk]
density_kg_per_m2 = 0.1
stretch_N_per_m = 300.0

[cloth.scarf]
size = [1.2, 1.2]
cells = [40, 40]
origin = [-0.6, 1.2, -0.6]
down = [0.0, 0.0, 1.0]
material = "silk"
finish = { pattern = "checker", repeat_m = 0.3, colour = "#a01020", accent = "#f0e8d8" }

[collider]
ball = { shape = "sphere", position = [0.0, 0.7, 0.0], radius = 0.3 }
ground = { shape = "plane" }

[camera.main]
eye = [1.6, 1.6, 1.9]
target = [0.0, 0.6, 0.0]
)";

int main(int count, char** arguments) try {
    const scene::LoadOptions options{.assetFolders = {ASSETS}};  // where fabrics are
    const scene::Loaded loaded = count > 1 ? scene::loadScene(arguments[1], options)
                                           : scene::loadSceneText(fallingCloth, "falling cloth", options);

    world::World world(loaded.spec);
    while (world.time() < 0.6)
        if (const auto divergence = world.advance()) {
            std::fprintf(stderr, "%s\n", divergence->message.c_str());
            return 1;
        }

    render::RendererOptions drawing;
    drawing.width = 640;
    drawing.height = 360;
    drawing.shaders = SHADERS;
    render::Renderer renderer(drawing);
    image::writePng(count > 2 ? arguments[2] : "picture.png", renderer.draw(world.view(false)));
    std::printf("t = %.3f s, drawn by %s\n", world.time(), renderer.info().renderer.c_str());
} catch (const core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
