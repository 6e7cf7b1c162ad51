#include "taut/render/private/light_maps.h"

#include <algorithm>

namespace taut::render {

LightMaps::LightMaps(const Gl& gl, int texels) : gl_(&gl), texels_(texels) {
    passes_.emplace_back(gl, texels);
}

void LightMaps::draw(std::span<const DrawItem> items, const LightSet& lights, bool anew) {
    used_ = 1 + lights.lampShadows.size();
    while (passes_.size() < used_) passes_.emplace_back(*gl_, texels_);
    passes_[0].draw(items, lights.sun, lights.kind.isWide, anew);
    for (std::size_t i = 1; i < used_; ++i) passes_[i].draw(items, lights.lampShadows[i - 1], lights.kind.isWide, anew);
}

bool LightMaps::isLit(std::span<const glm::vec3, 4> corners) const {
    return std::all_of(
        passes_.begin(), passes_.begin() + static_cast<std::ptrdiff_t>(used_),
        [&](const ShadowPass& pass) { return pass.isLit(corners); });
}

void LightMaps::bind() const {
    for (std::size_t i = 0; i < used_; ++i) passes_[i].bindMaps(i == 0 ? sunUnits : lampUnits(i - 1));
}

}  // namespace taut::render
