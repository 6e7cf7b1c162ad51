#include "taut/check/private/shadow.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace taut::check {
namespace {

constexpr std::size_t fewestStrips = 4000;

// Where a line of constant y cuts a triangle.
std::pair<double, double> cutAt(double y, const FlatTriangle& triangle) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = triangle[i], b = triangle[(i + 1) % 3];
        if ((a.y < y) == (b.y < y)) continue;
        const double x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        low = std::min(low, x);
        high = std::max(high, x);
    }
    return {low, high};
}

// Expects them sorted.
double coveredLength(const std::vector<std::pair<double, double>>& cuts) {
    double length = 0, end = -1e300;
    for (const auto& [low, high] : cuts) {
        if (high <= end) continue;
        length += high - std::max(low, end);
        end = high;
    }
    return length;
}

}  // namespace

double coveredArea(std::vector<FlatTriangle> triangles) {
    const auto lowest = [](const FlatTriangle& t) { return std::min({t[0].y, t[1].y, t[2].y}); };
    const auto highest = [](const FlatTriangle& t) { return std::max({t[0].y, t[1].y, t[2].y}); };
    std::stable_sort(triangles.begin(), triangles.end(),
                     [&](const auto& a, const auto& b) { return lowest(a) < lowest(b); });
    // Strips end at corners, at every so manieth if they are many; so small bodies far apart get theirs.
    std::vector<double> ends;
    for (const FlatTriangle& triangle : triangles)
        for (const glm::dvec2 corner : triangle) ends.push_back(corner.y);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    if (ends.size() < 2) return 0;
    const std::size_t every = 1 + ends.size() / (2 * fewestStrips), parts = 1 + fewestStrips / ends.size();
    double area = 0;
    std::size_t coming = 0;
    std::vector<const FlatTriangle*> here;
    std::vector<std::pair<double, double>> cuts;
    for (std::size_t begin = 0; begin + 1 < ends.size(); begin += every) {
        const double low = ends[begin], high = ends[std::min(begin + every, ends.size() - 1)];
        const double step = (high - low) / static_cast<double>(parts);
        for (std::size_t part = 0; part < parts; ++part) {
            const double y = low + (static_cast<double>(part) + 0.5) * step;
            while (coming < triangles.size() && lowest(triangles[coming]) < y) here.push_back(&triangles[coming++]);
            std::erase_if(here, [&](const FlatTriangle* triangle) { return highest(*triangle) < y; });
            cuts.clear();
            for (const FlatTriangle* triangle : here) cuts.push_back(cutAt(y, *triangle));
            std::sort(cuts.begin(), cuts.end());
            area += step * coveredLength(cuts);
        }
    }
    return area;
}

}  // namespace taut::check
