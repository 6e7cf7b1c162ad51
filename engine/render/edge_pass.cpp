#include "taut/render/edge_pass.h"

#include <vector>

namespace taut::render {

float itemMark(std::size_t item) {
    return static_cast<float>(item % 255 + 1) / 255.0F;
}

EdgePass::EdgePass(const Gl& gl, const ShaderFolder& shaders)
    : gl_(&gl),
      surfaces_(shaders.program("edges.vert", "edges.frag")),
      resolve_(shaders.program("tiles.vert", "resolve.frag")),
      tileLayout_(gl, GlKind::vertexArray),
      tileCorners_(gl, GlKind::buffer) {}

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
    const ShadedPixels shaded = targets.shaded(part);
    drawCoverage(view, items, meshes, part, targets);
    gl_->Flush();  // GL goes on drawing while the tiles are looked for
    const std::vector<PixelBox> tiles = edgeTiles(shaded);
    targets.bindResolve(part);
    gl_->Disable(GL_DEPTH_TEST);
    resolve_.use();
    drawTiles(tiles, targets.size());
}

void EdgePass::drawCoverage(const view::FrameView& view, std::span<const DrawItem> items, const MeshCache& meshes,
                            const PixelBox& part, const Targets& targets) {
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
        if (surface.twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        meshes.drawShape(items[i]);
    }
    gl_->Disable(GL_CULL_FACE);
    gl_->Disable(GL_CLIP_DISTANCE0);
    gl_->Disable(GL_SCISSOR_TEST);
}

// Two triangles a tile.
void EdgePass::drawTiles(std::span<const PixelBox> tiles, glm::ivec2 size) {
    std::vector<glm::vec2> corners;
    corners.reserve(6 * tiles.size());
    const auto place = [&](int x, int y) { return 2.0F * glm::vec2(x, y) / glm::vec2(size) - 1.0F; };
    for (const PixelBox& tile : tiles) {
        const int right = tile.x + tile.width, high = tile.y + tile.height;
        for (const glm::vec2& corner : {place(tile.x, tile.y), place(right, tile.y), place(right, high),
                                        place(tile.x, tile.y), place(right, high), place(tile.x, high)})
            corners.push_back(corner);
    }
    gl_->BindVertexArray(tileLayout_.id());
    gl_->BindBuffer(GL_ARRAY_BUFFER, tileCorners_.id());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec2)), corners.data(),
                    GL_STREAM_DRAW);
    gl_->EnableVertexAttribArray(0);
    gl_->VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    gl_->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
}

}  // namespace taut::render
