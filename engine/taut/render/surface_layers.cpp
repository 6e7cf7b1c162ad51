#include "taut/render/private/surface_layers.h"

#include <array>
#include <string>
#include <utility>

#include "taut/render/private/layer_pass.h"

namespace taut::render {
namespace {

// Draws the surfaces as for the colours, and converts them by a shader.
class SurfaceLayerPass : public LayerPass {
  public:
    SurfaceLayerPass(const Gl& gl, Program program, glm::ivec2 size, std::string comment)
        : gl_(&gl),
          program_(std::move(program)),
          target_(gl, size, true),
          empty_(gl, GlKind::vertexArray),
          comment_(std::move(comment)) {}

    void draw(const LayerScene& scene, image::Layer& layer) override {
        scene.targets.bindSurfaces();
        gl_->DepthMask(GL_TRUE);
        gl_->Clear(GL_DEPTH_BUFFER_BIT);
        const std::array<GLuint, 4> zeros{};
        gl_->ClearBufferuiv(GL_COLOR, 1, zeros.data());
        scene.surfaces.draw(scene.items, scene.meshes);
        scene.surfaces.bindMaterials();
        scene.targets.bindShading();  // with the surfaces
        target_.begin();
        gl_->Disable(GL_DEPTH_TEST);
        program_.use();
        gl_->BindVertexArray(empty_.id());
        gl_->DrawArrays(GL_TRIANGLES, 0, 3);
        target_.read(layer);
        layer.comment = comment_;
    }

  private:
    const Gl* gl_;
    Program program_;
    LayerTarget target_;
    GlObject empty_;
    std::string comment_;
};

class SurfaceLayer : public Layer {
  public:
    SurfaceLayer(std::string name, LayerFacts facts, std::string comment)
        : name_(std::move(name)), facts_(std::move(facts)), comment_(std::move(comment)) {}

    std::string name() const override { return name_; }
    LayerFacts facts() const override { return facts_; }
    std::unique_ptr<LayerPass> pass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size) const override {
        return std::make_unique<SurfaceLayerPass>(gl, shaders.program("screen.vert", name_ + ".frag"), size, comment_);
    }

  private:
    std::string name_;
    LayerFacts facts_;
    std::string comment_;
};

}  // namespace

std::shared_ptr<const Layer> normalsLayer() {
    return std::make_shared<SurfaceLayer>("normals", LayerFacts{{"axes", "scene"}},
                                          "normals in the axes of the scene: -1 to 1 is 0 to 65535; 0 0 0: background");
}

std::shared_ptr<const Layer> albedoLayer() {
    return std::make_shared<SurfaceLayer>("albedo", LayerFacts{{"curve", "sRGB"}},
                                          "colours of surfaces without light, sRGB; 0 0 0: background");
}

LayerKind normalsKind() {
    LayerKind kind{
        "normals",
        "Write a 16-bit NAME.normals.png beside each frame: normals of surfaces in the axes of the scene, -1 "
        "to 1 as 0-65535; ground and sky are 0"};
    kind.ask = [](double, const view::FrameView&) { return normalsLayer(); };
    return kind;
}

LayerKind albedoKind() {
    LayerKind kind{"albedo",
                   "Write a 16-bit NAME.albedo.png beside each frame: colours of surfaces without light, as sRGB; "
                   "ground and sky are 0"};
    kind.ask = [](double, const view::FrameView&) { return albedoLayer(); };
    return kind;
}

}  // namespace taut::render
