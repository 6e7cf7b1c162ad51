#include "taut/render/private/marks_pass.h"

#include <algorithm>
#include <cstddef>

namespace taut::render {

namespace {

constexpr float lineWidth = 1.5F;    // [px at 720p], never thinner than a pixel
constexpr float inFront = 0.996F;    // marks move this much closer to the eye, out of the surface that they lie on
constexpr float hiddenPart = 0.22F;  // strength of a mark behind a surface

// Marks fade a little towards the horizon's colour from the nearest to the farthest.
class DepthCue {
  public:
    DepthCue(const view::FrameView& view) : eye_(view.camera.eye), veil_(view.background.horizon) {
        const auto include = [&](glm::vec3 place) {
            const float distance = glm::distance(place, eye_);
            nearest_ = std::min(nearest_, distance);
            farthest_ = std::max(farthest_, distance);
        };
        for (const auto& line : view.marks.lines) include(line.from);
        for (const auto& dot : view.marks.dots) include(dot.at);
    }
    glm::vec3 colour(glm::vec3 own, glm::vec3 place) const {
        const float range = farthest_ - nearest_;
        if (!(range > 0.0F)) return own;
        const float part = std::clamp((glm::distance(place, eye_) - nearest_) / range, 0.0F, 1.0F);
        return glm::mix(own, veil_, 0.35F * part);
    }

  private:
    glm::vec3 eye_, veil_;
    float nearest_ = 1e30F;
    float farthest_ = 0.0F;
};

// Cuts off what lies behind the near plane; false if nothing is left.
bool clipNear(glm::vec4& a, glm::vec4& b) {
    const float distanceA = a.z + a.w;
    const float distanceB = b.z + b.w;
    if (distanceA <= 0.0F && distanceB <= 0.0F) return false;
    if (distanceA < 0.0F) a = glm::mix(a, b, distanceA / (distanceA - distanceB));
    if (distanceB < 0.0F) b = glm::mix(b, a, distanceB / (distanceB - distanceA));
    return a.w > 0.0F && b.w > 0.0F;
}

}  // namespace

MarksPass::MarksPass(const Gl& gl, const ShaderFolder& shaders)
    : gl_(&gl),
      program_(shaders.program("marks.vert", "marks.frag")),
      layout_(gl, GlKind::vertexArray),
      corners_(gl, GlKind::buffer),
      indices_(gl, GlKind::buffer) {
    gl.BindVertexArray(layout_.id());
    gl.BindBuffer(GL_ARRAY_BUFFER, corners_.id());
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    const auto attribute = [&](GLuint location, GLint size, std::size_t start) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Corner),
                               reinterpret_cast<const void*>(start));
    };
    attribute(0, 4, offsetof(Corner, clip));
    attribute(1, 3, offsetof(Corner, colour));
    attribute(2, 3, offsetof(Corner, shape));
}

void MarksPass::appendQuad(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    const auto first = static_cast<std::uint32_t>(quads_.size());
    quads_.insert(quads_.end(), {a, b, c, d});
    triangles_.insert(triangles_.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void MarksPass::collect(const view::FrameView& view, const glm::mat4& viewProjection, int width, int height) {
    quads_.clear();
    triangles_.clear();
    const float pixel = static_cast<float>(height) / 720.0F;
    const glm::vec2 screen(0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height));
    const DepthCue cue(view);
    const auto projected = [&](glm::vec3 place) {
        return viewProjection * glm::vec4(glm::mix(view.camera.eye, place, inFront), 1.0F);
    };
    const auto moved = [&](glm::vec4 clip, glm::vec2 pixels) {
        return glm::vec4(glm::vec2(clip) + pixels / screen * clip.w, clip.z, clip.w);
    };

    for (const auto& line : view.marks.lines) {
        glm::vec4 from = projected(line.from);
        glm::vec4 to = projected(line.to);
        if (!clipNear(from, to)) continue;
        const glm::vec2 along = (glm::vec2(to) / to.w - glm::vec2(from) / from.w) * screen;
        const float length = glm::length(along);
        if (!(length > 0.01F)) continue;
        const float half = std::max(0.5F * lineWidth * pixel, 0.5F);
        const glm::vec2 across = glm::vec2(-along.y, along.x) * ((half + 1.0F) / length);
        const glm::vec3 nearColour = cue.colour(line.colour, line.from);
        const glm::vec3 farColour = cue.colour(line.colour, line.to);
        const glm::vec3 left(0.0F, half + 1.0F, half);
        const glm::vec3 right(0.0F, -half - 1.0F, half);
        appendQuad({moved(from, across), nearColour, left}, {moved(from, -across), nearColour, right},
                   {moved(to, -across), farColour, right}, {moved(to, across), farColour, left});
    }
    for (const auto& dot : view.marks.dots) {
        const glm::vec4 at = projected(dot.at);
        if (at.z + at.w <= 0.0F || at.w <= 0.0F) continue;
        const float radius = std::max(dot.radius * pixel, 0.7F);
        const float reach = radius + 1.0F;
        const glm::vec3 colour = cue.colour(dot.colour, dot.at);
        const auto corner = [&](float x, float y) {
            return Corner{moved(at, {x * reach, y * reach}), colour, {x * reach, y * reach, radius}};
        };
        appendQuad(corner(-1.0F, -1.0F), corner(1.0F, -1.0F), corner(1.0F, 1.0F), corner(-1.0F, 1.0F));
    }
}

void MarksPass::draw(const view::FrameView& view, const glm::mat4& viewProjection, int width, int height) {
    collect(view, viewProjection, width, height);
    if (quads_.empty()) return;
    gl_->BindVertexArray(layout_.id());
    gl_->BindBuffer(GL_ARRAY_BUFFER, corners_.id());
    gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(quads_.size() * sizeof(Corner)), quads_.data(),
                    GL_STREAM_DRAW);
    gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles_.size() * sizeof(std::uint32_t)),
                    triangles_.data(), GL_STREAM_DRAW);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthMask(GL_FALSE);
    gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    program_.use();
    for (const bool hidden : {true, false}) {
        gl_->DepthFunc(hidden ? GL_GREATER : GL_LEQUAL);
        program_.set("strength", hidden ? hiddenPart : 1.0F);
        gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(triangles_.size()), GL_UNSIGNED_INT, nullptr);
    }
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
}

}  // namespace taut::render
