#include "render/texture_cache.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#include <stb_image.h>

#include <memory>

#include "core/error.h"

namespace taut::render {

GLuint TextureCache::texture(const std::string& path) {
    const auto known = textures_.find(path);
    if (known != textures_.end()) return known->second.id();

    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load(path.c_str(), &width, &height, &channels, 4), &stbi_image_free);
    if (pixels == nullptr) {
        throw core::Error(core::ExitCode::inputOutput, "cannot read the texture " + path + " (" +
                                                           stbi_failure_reason() + "); a PNG or JPEG file is needed");
    }
    GlObject texture(*gl_, GlKind::texture);
    gl_->BindTexture(GL_TEXTURE_2D, texture.id());
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.get());
    gl_->GenerateMipmap(GL_TEXTURE_2D);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    return textures_.emplace(path, std::move(texture)).first->second.id();
}

}  // namespace taut::render
