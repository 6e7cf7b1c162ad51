#include "taut/render/private/flow_layer.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "taut/render/private/edge_pass.h"
#include "taut/render/private/layer_pass.h"
#include "taut/render/private/thin_tubes.h"
#include "taut/view/camera_axes.h"

namespace taut::render {
namespace {

bool haveSameTriangles(const view::Surface& a, const view::Surface& b) {
    return a.topology == b.topology || (a.topology->triangles == b.topology->triangles &&
                                        a.geometry->positions.size() == b.geometry->positions.size());
}

// The surfaces of a view, and in the same order those of its next view: among equal names the first belongs to the
// first. A surface without a counterpart is its own.
struct Pairs {
    std::vector<view::Surface> now, next;
    std::vector<bool> isKnown;
};

Pairs pairsOf(const view::FrameView& view) {
    std::map<std::string, std::vector<const view::Surface*>> named;
    if (view.next)
        for (const view::Surface& surface : view.next->surfaces) named[surface.name].push_back(&surface);
    std::map<std::string, std::size_t> count;
    Pairs pairs;
    for (const view::Surface& surface : view.surfaces) {
        const auto& candidates = named[surface.name];
        const std::size_t number = count[surface.name]++;
        if (surface.topology->triangles.empty()) continue;
        const bool isKnown = number < candidates.size() && haveSameTriangles(surface, *candidates[number]);
        pairs.now.push_back(surface);
        pairs.next.push_back(isKnown ? *candidates[number] : surface);
        pairs.isKnown.push_back(isKnown);
    }
    return pairs;
}

class FlowPass : public LayerPass {
  public:
    FlowPass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size)
        : gl_(&gl),
          surfaces_(shaders.program("flow.vert", "flow.frag")),
          around_(shaders.program("screen.vert", "flow_around.frag")),
          target_(gl, size, true),
          now_(gl),
          next_(gl),
          empty_(gl, GlKind::vertexArray) {}

    void draw(const LayerScene& scene, image::Layer& layer) override {
        target_.begin();
        if (scene.view.next) {
            const float aspect = static_cast<float>(scene.size.x) / static_cast<float>(scene.size.y);
            const glm::mat4 projection = projectionOf(scene.view.next->camera, aspect);
            drawAround(scene, projection);
            drawSurfaces(scene, projection);
        }
        target_.read(layer);
        layer.comment =
            "motion to the next frame: right and down in pixels = (red, green - 32768) / 64 where blue is 1";
    }

  private:
    void drawAround(const LayerScene& scene, const glm::mat4& nextProjection) {
        gl_->Disable(GL_DEPTH_TEST);
        around_.use();
        around_.set("size", glm::vec2(scene.size));
        around_.set("nextProjection", nextProjection);
        around_.set("groundHeight", scene.view.ground ? scene.view.ground->height : scene.view.camera.eye.y);
        setRays(around_, scene.view.camera, scene.size, glm::vec2(0.0F));
        gl_->BindVertexArray(empty_.id());
        gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    }

    void drawSurfaces(const LayerScene& scene, const glm::mat4& nextProjection) {
        Pairs pairs = pairsOf(scene.view);
        const std::vector<DrawItem> plain = now_.items(pairs.now);
        const PixelScale scale(scene.view.camera, scene.size);
        for (std::size_t i = 0; i < plain.size(); ++i) {
            if (!isThin(plain[i], scale)) continue;
            pairs.now[i] = widened(pairs.now[i], scale, coveringRadius);
            pairs.next[i] = widened(pairs.next[i], scale, coveringRadius);
        }
        const std::vector<DrawItem> now = now_.items(pairs.now), next = next_.items(pairs.next);
        gl_->Enable(GL_DEPTH_TEST);
        surfaces_.use();
        surfaces_.set("size", glm::vec2(scene.size));
        surfaces_.set("nextProjection", nextProjection);
        surfaces_.set("seenSide", seenSideOf(scene.view));
        for (std::size_t i = 0; i < now.size(); ++i) {
            surfaces_.set("transform", now[i].surface->transform);
            surfaces_.set("nextTransform", next[i].surface->transform);
            surfaces_.set("isKnown", pairs.isKnown[i] ? 1.0F : 0.0F);
            if (now[i].surface->twoSided)
                gl_->Disable(GL_CULL_FACE);
            else
                gl_->Enable(GL_CULL_FACE);
            now_.draw(now[i], next[i].vertices);
        }
        gl_->Disable(GL_CULL_FACE);
    }

    const Gl* gl_;
    Program surfaces_, around_;
    LayerTarget target_;
    MeshCache now_, next_;
    GlObject empty_;
};

class FlowLayer : public Layer {
  public:
    std::string name() const override { return "flow"; }
    LayerFacts facts() const override {
        return {{"units_per_pixel", 64.0}, {"zero", std::int64_t{32768}}, {"axes", "right, down"}};
    }
    std::unique_ptr<LayerPass> pass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size) const override {
        return std::make_unique<FlowPass>(gl, shaders, size);
    }
};

}  // namespace

std::shared_ptr<const Layer> flowLayer() {
    return std::make_shared<FlowLayer>();
}

LayerKind flowKind() {
    LayerKind kind{
        "flow",
        "Write a 16-bit NAME.flow.png beside each frame: motion to the next frame in pixels, right and down, "
        "is (red and green - 32768) / 64 where blue is 1; simulates twice"};
    kind.needsNext = true;
    kind.ask = [](double, const view::FrameView&) { return flowLayer(); };
    return kind;
}

}  // namespace taut::render
