#include "taut/render/private/texture_cache.h"

#include <algorithm>

#include "taut/image/read.h"
#include "taut/render/private/program.h"

namespace taut::render {

void TextureCache::bind(const std::string& path) {
    gl_->ActiveTexture(GL_TEXTURE0 + pictureUnit);
    const auto known = textures_.find(path);
    if (known != textures_.end()) {
        gl_->BindTexture(GL_TEXTURE_2D, known->second.id());
        return;
    }

    const image::Image picture = image::readImage(path, std::min(image::mostPixels, budget_->pixels));
    budget_->pixels -= std::int64_t{picture.width} * picture.height;
    GlObject texture(*gl_, GlKind::texture);
    gl_->BindTexture(GL_TEXTURE_2D, texture.id());
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                    picture.rgb.data());
    gl_->GenerateMipmap(GL_TEXTURE_2D);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    textures_.emplace(path, std::move(texture));
}

}  // namespace taut::render
