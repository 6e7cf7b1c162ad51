// Films in code for the writers of geometry: a triangle that changes its shape, and one that moves as it is.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "taut/geometry/geometry_sink.h"

namespace taut::test {

// A folder of its own for a test, empty at first.
inline std::filesystem::path emptyFolder(const std::string& name) {
    const auto folder = std::filesystem::path(testing::TempDir()) / ("taut_geometry_" + name);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

inline std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline std::size_t filesIn(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

inline view::Surface triangle(const std::string& name) {
    view::Surface surface;
    surface.name = name;
    surface.topology = std::make_shared<view::Topology>(view::Topology{{0, 1, 2}, {{0, 0}, {1, 0}, {0, 1}}});
    surface.geometry = std::make_shared<view::Geometry>(
        view::Geometry{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<glm::vec3>(3, {0, 0, 1})});
    surface.finish = std::make_shared<view::Finish>();
    return surface;
}

// Frame k of 10 a second: of "cloth.flag" the third corner is at `height`, "ball" is at x = k.
struct Film {
    view::Surface flag = triangle("cloth.flag"), ball = triangle("ball");

    view::FrameView frame(std::int64_t k, float height) {
        auto shape = std::make_shared<view::Geometry>(*flag.geometry);
        shape->positions[2].y = height;
        flag.geometry = shape;
        ball.transform[3].x = static_cast<float>(k);
        view::FrameView view;
        view.frame = k;
        view.time = 0.1 * static_cast<double>(k);
        view.surfaces = {ball, flag};
        return view;
    }
};

}  // namespace taut::test
