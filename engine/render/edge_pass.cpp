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

PixelBox pixelBox(std::span<const DrawItem> items, const glm::mat4& viewProjection, int width, int height) {
    const glm::vec2 size(width, height);
    glm::vec2 low = size;
    glm::vec2 high(0.0F);
    for (const DrawItem& item : items) {
        for (const glm::vec3& corner : item.bounds.corners()) {
            const glm::vec4 clip = viewProjection * glm::vec4(corner, 1.0F);
            if (clip.z < -clip.w || clip.w <= 0.0F) return {0, 0, width, height};
            const glm::vec2 pixel = size * (0.5F + 0.5F * glm::vec2(clip) / clip.w);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
    }
    low = glm::clamp(glm::floor(low) - 1.0F, glm::vec2(0.0F), size);
    high = glm::clamp(glm::ceil(high) + 1.0F, low, size);
    const glm::ivec2 from(low);
    const glm::ivec2 extent(high - low);
    return {from.x, from.y, extent.x, extent.y};
}

void EdgePass::draw(const view::FrameView& view, std::span<const DrawItem> items, const MeshCache& meshes,
                    const PixelBox& part, Targets& targets) {
    if (part.width == 0 || part.height == 0) return;
    targets.bindCoverage();
    gl_->Scissor(part.x, part.y, part.width, part.height);
    gl_->Enable(GL_SCISSOR_TEST);
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

    targets.bindResolve(part);
    gl_->Enable(GL_SCISSOR_TEST);
    gl_->Disable(GL_DEPTH_TEST);
    gl_->BindVertexArray(empty_.id());
    resolve_.use();
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->Disable(GL_SCISSOR_TEST);
}

}  // namespace taut::render
