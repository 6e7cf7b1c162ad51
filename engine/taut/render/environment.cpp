#include "taut/render/private/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace taut::render {

namespace {

constexpr double pi = std::numbers::pi;

std::array<float, 9> polynomials(glm::vec3 n) {
    return {1.0F, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0F * n.y * n.y - 1.0F, n.x * n.z, n.x * n.x - n.z * n.z};
}

// Of each: the square of its norm over the sphere, and how much of its order a cosine lobe keeps, over π.
constexpr std::array<double, 9> kept{1.0 / (4.0 * pi),  0.5 / pi,           0.5 / pi,
                                     0.5 / pi,          15.0 / (16.0 * pi), 15.0 / (16.0 * pi),
                                     5.0 / (64.0 * pi), 15.0 / (16.0 * pi), 15.0 / (64.0 * pi)};

glm::vec3 pixelAt(const image::LightImage& picture, int x, int y) {
    const auto at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
    return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

void add(image::LightImage& picture, glm::vec3 pixel) {
    picture.rgb.insert(picture.rgb.end(), {pixel.x, pixel.y, pixel.z});
}

image::LightImage halved(const image::LightImage& picture) {
    image::LightImage half{std::max(picture.width / 2, 1), std::max(picture.height / 2, 1), {}};
    half.rgb.reserve(3 * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            const int right = std::min(2 * x + 1, picture.width - 1), below = std::min(2 * y + 1, picture.height - 1);
            add(half, 0.25F * (pixelAt(picture, 2 * x, 2 * y) + pixelAt(picture, right, 2 * y) +
                               pixelAt(picture, 2 * x, below) + pixelAt(picture, right, below)));
        }
    return half;
}

// The mean of each pixel's surroundings along the row, which closes in a ring: so many to either side, and a part of
// the next.
void blurRow(std::span<const glm::vec3> row, double halfWidth, image::LightImage& blurred) {
    const std::size_t width = row.size();
    std::vector<glm::dvec3> sums(3 * width + 1, glm::dvec3(0.0));  // of three rounds
    for (std::size_t i = 0; i < 3 * width; ++i) sums[i + 1] = sums[i] + glm::dvec3(row[i % width]);
    const auto sumTo = [&](double place) {
        const auto whole = static_cast<std::size_t>(place);
        return glm::mix(sums[whole], sums[std::min(whole + 1, 3 * width)], place - static_cast<double>(whole));
    };
    halfWidth = std::min(halfWidth, 0.5 * static_cast<double>(width));
    for (std::size_t x = 0; x < width; ++x) {
        const double middle = static_cast<double>(width + x) + 0.5;
        add(blurred, glm::vec3((sumTo(middle + halfWidth) - sumTo(middle - halfWidth)) / (2.0 * halfWidth)));
    }
}

image::LightImage blurredRows(const image::LightImage& picture) {
    image::LightImage blurred{picture.width, picture.height, {}};
    blurred.rgb.reserve(picture.rgb.size());
    std::vector<glm::vec3> row(static_cast<std::size_t>(picture.width));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) row[static_cast<std::size_t>(x)] = pixelAt(picture, x, y);
        blurRow(row, 0.5 / std::sin(pi * (y + 0.5) / picture.height), blurred);
    }
    return blurred;
}

}  // namespace

glm::vec3 AmbientLight::on(glm::vec3 normal) const {
    const std::array<float, 9> values = polynomials(normal);
    glm::vec3 light(0.0F);
    for (std::size_t i = 0; i < values.size(); ++i) light += values[i] * factors[i];
    return glm::max(light, 0.0F);
}

AmbientLight ambientLight(const image::LightImage& picture) {
    std::array<glm::dvec3, 9> sums{};
    const double step = 2.0 * pi / picture.width;  // [rad] of a pixel about the vertical
    for (int y = 0; y < picture.height; ++y) {
        const double top = std::cos(pi * y / picture.height), bottom = std::cos(pi * (y + 1) / picture.height);
        const double up = 0.5 * (top + bottom), aside = std::sqrt(1.0 - up * up);
        for (int x = 0; x < picture.width; ++x) {
            const double turn = step * (x + 0.5) - pi;
            const std::array<float, 9> values =
                polynomials(glm::vec3(aside * std::sin(turn), up, -aside * std::cos(turn)));
            const glm::dvec3 light = step * (top - bottom) * glm::dvec3(pixelAt(picture, x, y));
            for (std::size_t i = 0; i < values.size(); ++i) sums[i] += double{values[i]} * light;
        }
    }
    AmbientLight ambient;
    for (std::size_t i = 0; i < sums.size(); ++i) ambient.factors[i] = glm::vec3(kept[i] * sums[i]);
    return ambient;
}

std::vector<image::LightImage> blurredLevels(image::LightImage picture, int widest) {
    while (picture.width > widest) picture = halved(picture);
    std::vector<image::LightImage> levels;
    levels.push_back(std::move(picture));
    for (image::LightImage half = halved(levels.front()); half.width >= 8; half = halved(half))
        levels.push_back(blurredRows(half));
    return levels;
}

}  // namespace taut::render
