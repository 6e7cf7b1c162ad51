#include "taut/render/ground_pass.h"

#include <vector>

#include "taut/render/camera_axes.h"

namespace taut::render {

GroundPass::GroundPass(const Gl& gl, const ShaderFolder& shaders)
    : gl_(&gl),
      shaded_(shaders.program("ground.vert", "ground.frag", {"SHADED"})),
      open_(shaders.program("ground.vert", "ground.frag")),
      layout_(gl, GlKind::vertexArray),
      vertices_(gl, GlKind::buffer),
      indices_(gl, GlKind::buffer) {}

void GroundPass::draw(const view::FrameView& view, const LightBox& box, std::span<const Bounds> casters,
                      const std::optional<OcclusionArea>& occlusion) {
    const GroundMesh mesh = groundMesh(view.camera.target, view.ground->height, fadeOf(view).end, box, casters,
                                       view.light.softness, occlusion);
    gl_->BindVertexArray(layout_.id());
    gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.positions.size() * sizeof(glm::vec3)),
                    mesh.positions.data(), GL_STREAM_DRAW);
    gl_->EnableVertexAttribArray(0);
    gl_->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->Disable(GL_CULL_FACE);
    const auto drawCells = [&](const Program& program, const std::vector<std::uint32_t>& triangles) {
        if (triangles.empty()) return;
        program.use();
        gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(std::uint32_t)),
                        triangles.data(), GL_STREAM_DRAW);
        gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles.size()), GL_UNSIGNED_INT, nullptr);
    };
    drawCells(shaded_, mesh.shaded);
    drawCells(open_, mesh.open);
}

}  // namespace taut::render
