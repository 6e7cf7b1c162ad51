#include "taut/render/private/ground_pass.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "taut/render/private/edge_kernels.h"
#include "taut/render/private/edge_pass.h"
#include "taut/view/camera_axes.h"

namespace taut::render {

namespace {

constexpr int steadyPictures = 8;  // after so many with the maps in the same place, what they shade is kept

}  // namespace

GroundPass::GroundPass(const Gl& gl, const ShaderFolder& shaders, TextureBudget& budget, const RendererOptions& options)
    : gl_(&gl),
      keepsStill_(options.keepsStill),
      isTransparent_(options.alpha),
      plainByGl_(options.plainByGl),
      shaders_(&shaders),
      textures_(gl, budget),
      layout_(gl, GlKind::vertexArray),
      vertices_(gl, GlKind::buffer),
      indices_(gl, GlKind::buffer),
      empty_(gl, GlKind::vertexArray) {
    groundsUnder({});
}

GroundPass::Grounds& GroundPass::groundsUnder(const LightKind& kind, view::Pattern pattern) {
    const auto known = grounds_.find({kind, pattern});
    if (known != grounds_.end()) return known->second;
    const auto program = [&](const std::string& name, std::vector<std::string> definitions) {
        const std::vector<std::string> lights = definitionsOf(kind);
        definitions.insert(definitions.end(), lights.begin(), lights.end());
        if (isTransparent_) definitions.emplace_back("TRANSPARENT");
        if (pattern != view::Pattern::plain)
            definitions.push_back("PATTERN " + std::to_string(static_cast<int>(pattern)));
        return shaders_->program(name + ".vert", name + ".frag", definitions);
    };
    Grounds grounds{program("ground", {"SHADED", "DARKENED"}), program("ground", {"DARKENED"}), program("ground", {}),
                    program("background", {})};
    return grounds_.emplace(std::pair(kind, pattern), std::move(grounds)).first->second;
}

bool GroundPass::Still::operator==(const Still& other) const {
    return groundHeight == other.groundHeight && pattern == other.pattern && environment == other.environment &&
           std::memcmp(&block, &other.block, sizeof(block)) == 0;
}

bool GroundPass::StillShade::operator==(const StillShade& other) const {
    return shapes == other.shapes && std::memcmp(&block, &other.block, sizeof(block)) == 0;
}

void GroundPass::begin(const view::FrameView& view, const FrameBlock& block, const LightSet& lights,
                       std::span<const DrawItem> items, const std::optional<OcclusionArea>& occlusion,
                       const LightMaps& maps, Targets& targets) {
    StillShade shade{block, {}};
    std::vector<Bounds> all, moving;
    for (const DrawItem& item : items) {
        all.insert(all.end(), item.pieces.begin(), item.pieces.end());
        if (item.isStill)
            shade.shapes.push_back(item.shape);
        else
            moving.insert(moving.end(), item.pieces.begin(), item.pieces.end());
    }
    // The light of a picture around is the same all over the ground: only what is seen of it counts here.
    LightKind kind = lights.kind;
    kind.isAround = view.environment && view.environment->isShown && !isTransparent_;
    const view::Finish* pattern = view.ground && !isTransparent_ ? view.ground->pattern.get() : nullptr;
    now_ = &groundsUnder(kind, pattern != nullptr ? pattern->pattern : view::Pattern::plain);
    isPlain_ = pattern == nullptr && !kind.isAround && !isTransparent_ && !plainByGl_;
    mesh_ = {};
    if (view.ground) {
        std::vector<Shadower> above{lights.sun};
        for (const Shadower& lamp : lights.lampShadows)
            if (towardsLight(lamp.box).y > 0.0F) above.push_back(lamp);
        mesh_ = groundMesh(view.camera.target, view.ground->height, fadeOf(view).end, above, all, occlusion, moving);
        if (isPlain_) leaveShaded(mesh_, [&](std::span<const glm::vec3, 4> corners) { return maps.isLit(corners); });
        gl_->BindVertexArray(layout_.id());
        gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
        gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.positions.size() * sizeof(glm::vec3)),
                        mesh_.positions.data(), GL_STREAM_DRAW);
        gl_->EnableVertexAttribArray(0);
        gl_->VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }

    // Where the maps lie is nothing that the open ground knows.
    Still now{block, view.ground ? std::optional(view.ground->height) : std::nullopt,
              pattern != nullptr ? std::optional(*pattern) : std::nullopt, view.environment};
    now.block.toMap = glm::mat4(0.0F);
    now.block.mapSize = now.block.occlusionArea = glm::vec4(0.0F);
    now.block.lightColour.w = 0.0F;
    for (LampBlock& lamp : now.block.lamps) {
        lamp.toMap = glm::mat4(0.0F);
        lamp.mapSize = glm::vec4(0.0F);
        lamp.colour.w = 0.0F;
    }
    const bool isStill = keepsStill_ && !isPlain_ && !view.showMarks && before_ == now;
    before_ = now;
    shadeStays_ = isStill && shadeNow_ == shade ? shadeStays_ + 1 : 0;
    shadeNow_ = std::move(shade);
    if (isStill && (!isKept_ || shadeStays_ == steadyPictures)) keep(block.viewProjection, targets);
    isKept_ = isStill;
    if (!isKept_) return;
    leaveOut(mesh_.open, Look::open);
    leaveOut(mesh_.darkened, Look::darkened);
    leaveOut(mesh_.shaded, Look::shaded);
}

void GroundPass::forget() {
    before_.reset();
    keptShade_.reset();
    shadeStays_ = 0;
    isKept_ = false;
}

void GroundPass::keep(const glm::mat4& projection, Targets& targets) {
    const bool keepsShade = shadeStays_ >= steadyPictures;
    keptShade_ = keepsShade ? shadeNow_ : std::nullopt;
    looks_.assign(mesh_.positions.size(), Look::open);
    std::vector<std::uint32_t> open = mesh_.open, darkened, shaded;
    const auto sort = [&](const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& kept, Look look) {
        for (std::size_t i = 0; i < cells.size(); i += 6) {
            const bool isKept = keepsShade && mesh_.changes[cells[i]] == 0;
            std::vector<std::uint32_t>& triangles = isKept ? kept : open;
            triangles.insert(triangles.end(), cells.begin() + static_cast<std::ptrdiff_t>(i),
                             cells.begin() + static_cast<std::ptrdiff_t>(i) + 6);
            if (isKept) looks_[cells[i]] = look;
        }
    };
    sort(mesh_.darkened, darkened, Look::darkened);
    sort(mesh_.shaded, shaded, Look::shaded);
    targets.bindShading();
    gl_->DepthMask(GL_TRUE);
    gl_->Clear(GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    drawCells(now_->shaded, shaded);
    drawCells(now_->darkened, darkened);
    drawOpen(projection, open);
    targets.colours(keptColours_);
    targets.depths({0, 0, targets.size().x, targets.size().y}, keptDepths_);
}

// Leaves the cells that have to be drawn: those that do not look so in what is kept.
void GroundPass::leaveOut(std::vector<std::uint32_t>& triangles, Look look) const {
    const bool isShadeKept = keptShade_ && keptShade_ == shadeNow_;
    std::size_t left = 0;
    for (std::size_t i = 0; i < triangles.size(); i += 6) {
        const std::uint32_t cell = triangles[i];
        if (looks_[cell] == look && (look == Look::open || (isShadeKept && mesh_.changes[cell] == 0))) continue;
        std::copy_n(triangles.begin() + static_cast<std::ptrdiff_t>(i), 6,
                    triangles.begin() + static_cast<std::ptrdiff_t>(left));
        left += 6;
    }
    triangles.resize(left);
}

void GroundPass::draw(const glm::mat4& projection) {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    drawCells(now_->shaded, mesh_.shaded);
    if (isPlain_) return;
    drawCells(now_->darkened, mesh_.darkened);
    if (isKept_)
        drawCells(now_->open, mesh_.open);
    else
        drawOpen(projection, mesh_.open);
}

void GroundPass::fill(const PixelBox& part, std::span<float> depths, std::span<std::uint32_t> colours,
                      int width) const {
    if (!isKept_) return;
    const EdgeKernels kernels = edgeKernels();
    kernels.fillUndrawn(colours.size(), nothingMark, keptColours_.data(), colours.data());
    for (int y = 0; y < part.height; ++y) {
        const auto first = static_cast<std::size_t>((y + part.y) * width + part.x);
        kernels.fillNearer(static_cast<std::size_t>(part.width), keptColours_.data() + first,
                           keptDepths_.data() + first, colours.data() + first,
                           depths.data() + static_cast<std::ptrdiff_t>(y) * part.width);
    }
}

void GroundPass::drawOpen(const glm::mat4& projection, const std::vector<std::uint32_t>& triangles) {
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(GL_LESS);
    drawCells(now_->open, triangles);
    gl_->DepthFunc(GL_LEQUAL);
    gl_->BindVertexArray(empty_.id());
    now_->background.use();
    now_->background.set("toWorld", glm::inverse(projection));
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void GroundPass::drawCells(Program& program, const std::vector<std::uint32_t>& triangles) {
    if (triangles.empty()) return;
    gl_->Disable(GL_CULL_FACE);
    gl_->BindVertexArray(layout_.id());
    gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    program.use();
    if (const std::optional<view::Finish>& pattern = before_->pattern) {
        program.set("frontColour", pattern->front);
        program.set("accentColour", pattern->accent);
        program.set("repeat", std::max(pattern->repeat, 1e-4F));
        if (pattern->pattern == view::Pattern::image) textures_.bind(pattern->texture);
    }
    gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(std::uint32_t)),
                    triangles.data(), GL_STREAM_DRAW);
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace taut::render
