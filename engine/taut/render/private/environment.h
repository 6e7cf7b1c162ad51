// The light of the surroundings in a picture: the part that falls onto a surface, and its blurred levels. Without GL.
// The picture is equirectangular: its middle lies at -z, its right quarter at +x, its upper edge at +y.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "taut/image/private/light_image.h"

namespace taut::render {

// The light of a white matt surface under it, to the second order of spherical harmonics, with an average error of 3 %
// at most (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps", 2001). Factors of
// 1; y, z, x; xy, yz, 3y² - 1, xz, x² - z² of the unit normal.
struct AmbientLight {
    std::array<glm::vec3, 9> factors{};

    glm::vec3 on(glm::vec3 normal) const;
};

AmbientLight ambientLight(const image::LightImage& picture);

// The picture, halved in size as often as it takes to be at most `widest` pixels wide, and the same halved again and
// again, down to 8 wide. But for the first all are blurred along their rows besides, by as much as directions lie
// closer there than at the horizon: a texel of each stands for a cone as wide as a texel is high.
std::vector<image::LightImage> blurredLevels(image::LightImage picture, int widest);

}  // namespace taut::render
