// Which knot a rope is in: its determinant, by colouring the arcs of its picture (Fox). 1: none; 3: an overhand knot.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace taut::test {

using glm::dvec3;

// Of a rope whose ends go on, straight and for ever, the way that they lie apart: closed far away.
inline double knotDeterminant(std::vector<dvec3> rope) {
    const dvec3 out = rope.back() - rope.front();
    dvec3 low = rope.front(), high = rope.front();
    for (const dvec3& x : rope) low = glm::min(low, x), high = glm::max(high, x);
    const double far = 50.0 * glm::length(high - low);
    const dvec3 along = glm::normalize(out), aside = glm::normalize(glm::cross(along, dvec3(0.31, 0.83, 0.46)));
    rope.insert(rope.begin(), rope.front() - far * along);
    rope.push_back(rope.back() + far * along);
    rope.push_back(rope.back() + far * aside);
    rope.insert(rope.begin(), rope.front() + far * aside);
    // Looked at along a way in which nothing lies exactly over anything.
    const dvec3 eye = glm::normalize(dvec3(0.187, 0.351, 0.917)), right = glm::normalize(glm::cross(eye, along)),
                up = glm::cross(eye, right);
    const auto flat = [&](const dvec3& x) { return glm::dvec2(glm::dot(x, right), glm::dot(x, up)); };
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const std::size_t n = rope.size();
    struct Under {
        double at;         // in segments from the start
        double overOther;  // the same of the strand over it
    };
    std::vector<Under> unders;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            const dvec3 &a = rope[i], &b = rope[i + 1], &c = rope[j], &d = rope[(j + 1) % n];
            const glm::dvec2 p = flat(a), r = flat(b) - p, q = flat(c), s = flat(d) - q;
            const double size = cross(r, s);
            if (size == 0) continue;
            const double t = cross(q - p, s) / size, u = cross(q - p, r) / size;
            if (t < 0 || t >= 1 || u < 0 || u >= 1) continue;
            const double first = glm::dot(eye, a + t * (b - a)), second = glm::dot(eye, c + u * (d - c));
            const double atFirst = static_cast<double>(i) + t, atSecond = static_cast<double>(j) + u;
            if (first < second)
                unders.push_back({atFirst, atSecond});
            else
                unders.push_back({atSecond, atFirst});
        }
    std::sort(unders.begin(), unders.end(), [](const Under& a, const Under& b) { return a.at < b.at; });
    const std::size_t count = unders.size();
    if (count < 2) return 1.0;
    // Arc k ends at the crossing k under another; the last goes on to the first.
    const auto arcAt = [&](double place) {
        std::size_t k = 0;
        while (k < count && unders[k].at < place) ++k;
        return k % count;
    };
    std::vector<std::vector<double>> m(count, std::vector<double>(count, 0.0));
    for (std::size_t k = 0; k < count; ++k) {
        m[k][arcAt(unders[k].overOther)] += 2;
        m[k][k] -= 1;
        m[k][(k + 1) % count] -= 1;
    }
    // Determinant without the last row and column.
    double determinant = 1;
    const std::size_t size = count - 1;
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t best = k;
        for (std::size_t i = k; i < size; ++i)
            if (std::abs(m[i][k]) > std::abs(m[best][k])) best = i;
        if (std::abs(m[best][k]) < 1e-9) return 0.0;
        std::swap(m[best], m[k]);
        determinant *= m[k][k];
        for (std::size_t i = k + 1; i < size; ++i) {
            const double share = m[i][k] / m[k][k];
            for (std::size_t j = k; j < size; ++j) m[i][j] -= share * m[k][j];
        }
    }
    return std::abs(determinant);
}

}  // namespace taut::test
