#include "taut/render/private/surface_pass.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/render/private/edge_pass.h"
#include "taut/render/private/targets.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

constexpr std::size_t mostMaterials = 16384;  // GL takes textures of that many rows

bool isWoven(const view::Finish& finish) {
    return finish.weave > 0.0F || finish.fuzz > 0.0F;
}

}  // namespace

Rays raysOf(const view::Camera& camera, glm::ivec2 size, glm::vec2 shift) {
    const view::CameraAxes axes = axesOf(camera);
    const float pixel =
        2.0F * std::tan(0.5F * verticalField(camera, size)) / static_cast<float>(size.y);  // [m] 1 m ahead
    const glm::vec2 half = 0.5F * glm::vec2(size) + shift;
    return {axes.forward - pixel * (half.x * axes.right + half.y * axes.up), pixel * axes.right, pixel * axes.up};
}

void setRays(Program& program, const view::Camera& camera, glm::ivec2 size, glm::vec2 shift) {
    const Rays rays = raysOf(camera, size, shift);
    program.set("firstWay", rays.first);
    program.set("rightWay", rays.right);
    program.set("upWay", rays.up);
}

SurfacePass::SurfacePass(const Gl& gl, const ShaderFolder& shaders, TextureBudget& budget)
    : gl_(&gl),
      shaders_(&shaders),
      textures_(gl, budget),
      occlusion_(shaders.program("screen.vert", "nearby.frag")),
      materialTexture_(gl, GlKind::texture),
      empty_(gl, GlKind::vertexArray) {
    programUnder({});
    gl.BindTexture(GL_TEXTURE_2D, materialTexture_.id());
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Program& SurfacePass::programFor(const view::Surface& surface) {
    const view::Finish& finish = *surface.finish;
    std::vector<std::string> definitions{"PATTERN " + std::to_string(static_cast<int>(finish.pattern))};
    if (isWoven(finish)) definitions.push_back("WEAVE " + std::to_string(static_cast<int>(finish.binding)));
    if (finish.slub > 0.0F) definitions.emplace_back("SLUB");
    if (finish.fuzz > 0.0F) definitions.emplace_back("FUZZ");
    if (surface.twoSided) definitions.emplace_back("TWO_SIDED");
    if (finish.anisotropy > 0.0F) definitions.emplace_back("FIBRES");
    const auto known = programs_.find(definitions);
    if (known != programs_.end()) return known->second;
    Program program = shaders_->program("surface.vert", "surface.frag", definitions);
    return programs_.emplace(std::move(definitions), std::move(program)).first->second;
}

Program& SurfacePass::programUnder(const LightKind& kind) {
    const auto known = lights_.find(kind);
    if (known != lights_.end()) return known->second;
    return lights_.emplace(kind, shaders_->program("screen.vert", "light.frag", definitionsOf(kind))).first->second;
}

// Neighbours mostly share a material: it is looked for from the last backwards.
int SurfacePass::rowOf(const view::Surface& surface) {
    const view::Finish& finish = *surface.finish;
    const Material material{glm::vec4(finish.back, finish.roughness),
                            {finish.sheen, surface.dulled - surface.greyed,
                             surface.twoSided ? finish.translucency : 0.0F, isWoven(finish) ? 1.0F : 0.0F},
                            {finish.anisotropy, finish.fuzz, 0.0F, 0.0F}};
    const auto known = std::find(materials_.rbegin(), materials_.rend(), material);
    if (known != materials_.rend()) return static_cast<int>(materials_.rend() - known) - 1;
    if (materials_.size() == mostMaterials)
        throw core::Error(core::ErrorKind::badContent,
                          "more than 16384 kinds of surface cannot be drawn in one picture");
    materials_.push_back(material);
    return static_cast<int>(materials_.size()) - 1;
}

void SurfacePass::draw(std::span<const DrawItem> items, const MeshCache& meshes) {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    gl_->DepthMask(GL_TRUE);
    materials_.clear();
    for (std::size_t i = 0; i < items.size(); ++i) {
        const DrawItem& item = items[i];
        const view::Surface& surface = *item.surface;
        const view::Finish& finish = *surface.finish;
        Program& program = programFor(surface);
        program.use();
        program.set("transform", surface.transform);
        program.set("normalTransform", glm::transpose(glm::inverse(glm::mat3(surface.transform))));
        program.set("frontColour", finish.front);
        program.set("accentColour", finish.accent);
        program.set("repeat", std::max(finish.repeat, 1e-4F));
        program.set("weave", finish.weave);
        program.set("weftColour", finish.back);
        program.set("thread", std::max(finish.thread, 1e-5F));
        program.set("slub", finish.slub);
        program.set("fuzz", finish.fuzz);
        program.set("material", rowOf(surface));
        program.set("mark", static_cast<int>(std::lround(255.0F * itemMark(i))));
        if (finish.pattern == view::Pattern::image) textures_.bind(finish.texture);
        if (surface.twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        meshes.draw(item);
    }
    gl_->Disable(GL_CULL_FACE);
}

void SurfacePass::bindMaterials() {
    gl_->ActiveTexture(GL_TEXTURE0 + materialsUnit);
    gl_->BindTexture(GL_TEXTURE_2D, materialTexture_.id());
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 3, static_cast<GLsizei>(materials_.size()), 0, GL_RGBA, GL_FLOAT,
                    materials_.data());
}

void SurfacePass::light(const LightKind& kind, const view::Camera& camera, const PixelBox& part, const Targets& targets,
                        glm::vec2 shift, bool occlusion) {
    if (materials_.empty() || part.width == 0 || part.height == 0) return;
    const glm::ivec2 size = targets.size();
    gl_->BindVertexArray(empty_.id());
    gl_->Enable(GL_SCISSOR_TEST);
    targets.bindHidden();
    gl_->Disable(GL_DEPTH_TEST);
    gl_->Scissor(part.x / 2 - 1, part.y / 2 - 1, part.width / 2 + 3, part.height / 2 + 3);
    occlusion_.use();
    setRays(occlusion_, camera, size, shift);
    occlusion_.set("ends", 1.0F / glm::vec2(camera.nearPlane, camera.farPlane));
    occlusion_.set("strength", occlusion ? 1.0F : 0.0F);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);

    targets.bindShading();
    bindMaterials();
    Program& light = programUnder(kind);
    light.use();
    setRays(light, camera, size, shift);
    // At the far plane, where something lies before it.
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_GREATER);
    gl_->DepthMask(GL_FALSE);
    gl_->Scissor(part.x, part.y, part.width, part.height);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->Disable(GL_SCISSOR_TEST);
    gl_->DepthMask(GL_TRUE);
}

}  // namespace taut::render
