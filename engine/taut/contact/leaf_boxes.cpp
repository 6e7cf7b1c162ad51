#include "taut/contact/leaf_boxes.h"

#include <array>
#include <cmath>

namespace taut::contact {
namespace {

// At least as far out as the number, whichever way it was rounded.
constexpr double outwards = 2e-7;

float below(double x) {
    return static_cast<float>(x - outwards * std::abs(x));
}
float above(double x) {
    return static_cast<float>(x + outwards * std::abs(x));
}

}  // namespace

FloatBox floatBox(const core::Aabb& box, double reach) {
    FloatBox own{};
    for (int k = 0; k < 3; ++k) {
        own.low[k] = below(box.low[k] - reach);
        own.high[k] = above(box.high[k] + reach);
    }
    return own;
}

void findPointBoxes(std::span<const dvec3> x, std::vector<FloatBox>& boxes) {
    boxes.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        boxes[i] = {{below(x[i].x), below(x[i].y), below(x[i].z), 0}, {above(x[i].x), above(x[i].y), above(x[i].z), 0}};
}

FloatBox ElementBoxes::box(int i, float reach) const {
    FloatBox box{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double low = row(k)[i], high = row(k + 3)[i];
        box.low[k] = below(low - reach);
        box.high[k] = above(high + reach);
    }
    return box;
}

bool ElementBoxes::findHits(const FloatBox& box, const ClosestKernels& kernels,
                            std::vector<std::uint64_t>& hits) const {
    hits.resize((stride_ + 63) / 64);
    const BoxLanes lanes{static_cast<int>(stride_), {row(0), row(1), row(2)}, {row(3), row(4), row(5)}};
    return kernels.findOverlapping(lanes, box.low, box.high, hits.data());
}

void LeafBoxes::find(const Elements& elements, const BvhLeaf& leaf, std::span<const FloatBox> ofPoints) {
    const auto at = [&](int i) -> const FloatBox& { return ofPoints[static_cast<std::size_t>(i)]; };
    points.fill(leaf.points, at);
    triangles.fill(leaf.triangles, [&](int t) {
        const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
        const std::array<int, 3>& c = triangle.points;
        return triangle.isGone ? FloatBox::none() : at(c[0]).joined(at(c[1])).joined(at(c[2]));
    });
    edges.fill(leaf.edges, [&](int e) {
        const Edge& edge = elements.edges()[static_cast<std::size_t>(e)];
        return edge.isGone ? FloatBox::none() : at(edge.a).joined(at(edge.b));
    });
}

}  // namespace taut::contact
