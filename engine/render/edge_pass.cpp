#include "render/edge_pass.h"

namespace taut::render {

float itemMark(std::size_t item) {
    return static_cast<float>(item % 255 + 1) / 255.0F;
}

EdgePass::EdgePass(const Gl& gl, const ShaderFolder& shaders)
    : gl_(&gl),
      surfaces_(shaders.program("edges.vert", "edges.frag")),
      resolve_(shaders.program("screen.vert", "resolve.frag")),
      empty_(gl, GlKind::vertexArray) {}

void EdgePass::draw(const view::FrameView& view, std::span<const DrawItem> items, const MeshCache& meshes,
                    Targets& targets) {
    targets.bindCoverage();
    gl_->DepthMask(GL_TRUE);
    gl_->ClearColor(0.0F, 0.0F, 0.0F, 0.0F);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    surfaces_.use();
    glm::vec4 seenSide(0.0F, 0.0F, 0.0F, 1.0F);
    if (view.ground) {
        const float side = view.camera.eye.y >= view.ground->height ? 1.0F : -1.0F;
        seenSide = glm::vec4(0.0F, side, 0.0F, -side * view.ground->height);
        gl_->Enable(GL_CLIP_DISTANCE0);
    }
    surfaces_.set("seenSide", seenSide);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const view::Surface& surface = *items[i].surface;
        surfaces_.set("transform", surface.transform);
        surfaces_.set("mark", itemMark(i));
        if (surface.twoSided) {
            gl_->Disable(GL_CULL_FACE);
        } else {
            gl_->Enable(GL_CULL_FACE);
        }
        meshes.drawShape(items[i]);
    }
    gl_->Disable(GL_CULL_FACE);
    gl_->Disable(GL_CLIP_DISTANCE0);

    targets.bindResolve();
    gl_->Disable(GL_DEPTH_TEST);
    gl_->BindVertexArray(empty_.id());
    resolve_.use();
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace taut::render
