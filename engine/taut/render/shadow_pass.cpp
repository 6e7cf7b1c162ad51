#include "taut/render/private/shadow_pass.h"

#include <array>
#include <string>
#include <utility>

#include "taut/core/error.h"
#include "taut/render/private/program.h"

namespace taut::render {

namespace {

constexpr std::array<float, 4> lit{1.0F, 1.0F, 1.0F, 1.0F};

int checkedSize(const Gl& gl, int texels) {
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (texels < boundsEdge || texels % boundsEdge != 0 || texels > largest) {
        throw core::Error(core::ErrorKind::badContent,
                          "a shadow map of " + std::to_string(texels) +
                              " texels cannot be drawn: it must be a multiple of 128, at most " +
                              std::to_string(largest));
    }
    return texels;
}

// A square texture, outside which everything is lit.
GlObject mapTexture(const Gl& gl, int edge, GLenum format, GLenum layout, GLenum type, GLint filter) {
    GlObject texture(gl, GlKind::texture);
    gl.BindTexture(GL_TEXTURE_2D, texture.id());
    gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), edge, edge, 0, layout, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, lit.data());
    return texture;
}

}  // namespace

ShadowPass::ShadowPass(const Gl& gl, int texels)
    : gl_(&gl),
      map_(checkedSize(gl, texels)),
      depth_(mapTexture(gl, texels, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, GL_NEAREST)),
      bounds_(mapTexture(gl, boundsEdge, GL_RG32F, GL_RG, GL_FLOAT, GL_LINEAR)),
      comparing_(gl, GlKind::sampler) {
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    gl.SamplerParameteri(comparing_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    gl.SamplerParameterfv(comparing_.id(), GL_TEXTURE_BORDER_COLOR, lit.data());
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl.BindTexture(GL_TEXTURE_2D, depth_.id());
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, texels, texels, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT,
                     map_.depths().data());
}

void ShadowPass::draw(std::span<const DrawItem> items, const Shadower& light, bool isWide, bool anew) {
    const LightBox& box = light.box;
    const int wide = isWide ? light.blocks : 0;
    std::vector<ShadowShape> shapes;
    for (const DrawItem& item : items) shapes.push_back(item.shape);
    if (!anew && box.toMap == drawnBox_ && wide == wide_ && shapes == shapes_) return;
    shapes_ = std::move(shapes);
    drawnBox_ = box.toMap;
    wide_ = wide;
    map_.draw(items, box);
    gl_->ActiveTexture(GL_TEXTURE0 + shadowDepthUnit);
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->BindTexture(GL_TEXTURE_2D, depth_.id());
    for (int strip = 0; strip < ShadowMap::strips; ++strip) {
        const int low = strip * map_.rowsAStrip();
        if (!map_.hasChanged(strip)) continue;
        gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, low, map_.edge(), map_.rowsAStrip(), GL_DEPTH_COMPONENT,
                           GL_UNSIGNED_SHORT, map_.depths().data() + static_cast<std::ptrdiff_t>(low) * map_.edge());
    }
    gl_->BindTexture(GL_TEXTURE_2D, bounds_.id());
    bounded_ = wide > 0 ? map_.boundsWithin(wide) : map_.bounds();
    if (wide > 0)
        putWideBounds();
    else
        gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, boundsEdge, boundsEdge, 0, GL_RG, GL_FLOAT, map_.bounds().data());
}

void ShadowPass::putWideBounds() {
    const std::vector<glm::vec2>& narrow = map_.bounds();
    std::vector<glm::vec4> both;
    for (std::size_t i = 0; i < narrow.size(); ++i) both.emplace_back(narrow[i], bounded_[i]);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, boundsEdge, boundsEdge, 0, GL_RGBA, GL_FLOAT, both.data());
}

bool ShadowPass::isLit(std::span<const glm::vec3, 4> corners) const {
    std::array<glm::vec3, 4> onMap{};
    for (std::size_t i = 0; i < 4; ++i) onMap[i] = glm::vec3(drawnBox_ * glm::vec4(corners[i], 1.0F));
    return render::isLit(bounded_, onMap);
}

void ShadowPass::bindMaps(const ShadowUnits& units) const {
    const auto bind = [&](int unit, const GlObject& texture, GLuint sampler) {
        gl_->ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl_->BindTexture(GL_TEXTURE_2D, texture.id());
        gl_->BindSampler(static_cast<GLuint>(unit), sampler);
    };
    bind(units.map, depth_, comparing_.id());
    bind(units.depth, depth_, 0);
    bind(units.bounds, bounds_, 0);
}

}  // namespace taut::render
