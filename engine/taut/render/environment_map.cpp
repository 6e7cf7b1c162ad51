#include "taut/render/private/environment_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "taut/image/private/light_image.h"
#include "taut/render/private/program.h"

namespace taut::render {

namespace {

constexpr int widest = 4096;  // [px] of the largest level: 100 MB with the smaller ones

}  // namespace

EnvironmentMap::Known EnvironmentMap::read(const std::string& path) const {
    image::LightImage picture = image::readLightImage(path, std::min(image::mostLightPixels, budget_->pixels));
    image::expectAllAround(path, {picture.width, picture.height});
    budget_->pixels -= std::int64_t{picture.width} * picture.height;
    const std::vector<image::LightImage> levels = blurredLevels(std::move(picture), widest);
    Known known{GlObject(*gl_, GlKind::texture),
                ambientLight(*std::find_if(levels.begin(), levels.end() - 1,
                                           [](const image::LightImage& level) { return level.width <= 512; })),
                static_cast<float>(levels.front().height) / std::numbers::pi_v<float>};
    gl_->BindTexture(GL_TEXTURE_2D, known.texture.id());
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (std::size_t i = 0; i < levels.size(); ++i)
        gl_->TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA16F, levels[i].width, levels[i].height, 0, GL_RGB,
                        GL_FLOAT, levels[i].rgb.data());
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size() - 1));
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return known;
}

void EnvironmentMap::show(const view::FrameView& view, FrameBlock& block) {
    if (!view.environment) return;
    const view::Environment& environment = *view.environment;
    gl_->ActiveTexture(GL_TEXTURE0 + environmentUnit);
    auto found = known_.find(environment.picture);
    if (found == known_.end()) found = known_.emplace(environment.picture, read(environment.picture)).first;
    const Known& known = found->second;
    gl_->BindTexture(GL_TEXTURE_2D, known.texture.id());
    const float strength = environment.strength;
    block.around = {std::cos(environment.turn), std::sin(environment.turn), strength, known.texelsPerRadian};
    for (std::size_t i = 0; i < known.ambient.factors.size(); ++i)
        block.ambient[i] = glm::vec4(strength * known.ambient.factors[i], 0.0F);
    block.skyLight = glm::vec4(strength * known.ambient.on({0.0F, 1.0F, 0.0F}), 0.0F);
    block.groundLight = glm::vec4(strength * known.ambient.on({0.0F, -1.0F, 0.0F}), 0.0F);
}

}  // namespace taut::render
