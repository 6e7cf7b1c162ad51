#include "taut/render/surface_pass.h"

#include <algorithm>

#include "taut/render/edge_pass.h"

namespace taut::render {

Program& SurfacePass::programFor(const view::Surface& surface) {
    const bool woven = surface.finish->weave > 0.0F;
    const auto key = std::make_tuple(surface.finish->pattern, woven, surface.twoSided);
    const auto known = programs_.find(key);
    if (known != programs_.end()) return known->second;
    std::vector<std::string> definitions{"PATTERN " + std::to_string(static_cast<int>(surface.finish->pattern))};
    if (woven) definitions.emplace_back("WEAVE");
    if (surface.twoSided) definitions.emplace_back("TWO_SIDED");
    return programs_.emplace(key, shaders_->program("surface.vert", "surface.frag", definitions)).first->second;
}

void SurfacePass::draw(std::span<const DrawItem> items, const MeshCache& meshes) {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const DrawItem& item = items[i];
        const view::Surface& surface = *item.surface;
        const view::Finish& finish = *surface.finish;
        Program& program = programFor(surface);
        program.use();
        program.set("transform", surface.transform);
        program.set("normalTransform", glm::transpose(glm::inverse(glm::mat3(surface.transform))));
        program.set("frontColour", finish.front);
        program.set("backColour", finish.back);
        program.set("accentColour", finish.accent);
        program.set("repeat", std::max(finish.repeat, 1e-4F));
        program.set("weave", finish.weave);
        program.set("thread", std::max(finish.thread, 1e-5F));
        program.set("roughness", finish.roughness);
        program.set("sheen", finish.sheen);
        program.set("dulled", surface.dulled);
        program.set("mark", itemMark(i));
        if (finish.pattern == view::Pattern::image) textures_.bind(finish.texture);
        if (surface.twoSided)
            gl_->Disable(GL_CULL_FACE);
        else
            gl_->Enable(GL_CULL_FACE);
        meshes.draw(item);
    }
    gl_->Disable(GL_CULL_FACE);
}

}  // namespace taut::render
