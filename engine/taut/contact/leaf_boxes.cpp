#include "taut/contact/leaf_boxes.h"

#include <algorithm>
#include <limits>

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

void ElementBoxes::clear(std::size_t most) {
    constexpr float far = std::numeric_limits<float>::infinity();
    items_.clear();
    stride_ = (most + boxesAtOnce - 1) / boxesAtOnce * boxesAtOnce;
    rows_.resize(6 * stride_);
    std::fill(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(3 * stride_), far);
    std::fill(rows_.begin() + static_cast<std::ptrdiff_t>(3 * stride_), rows_.end(), -far);
}

void ElementBoxes::add(int number, const FloatBox& box) {
    const std::size_t i = items_.size();
    items_.push_back(number);
    for (std::size_t k = 0; k < 3; ++k) {
        rows_[k * stride_ + i] = box.low[k];
        rows_[(k + 3) * stride_ + i] = box.high[k];
    }
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
    hits.resize((items_.size() + 63) / 64);
    const std::size_t whole = (items_.size() + boxesAtOnce - 1) / boxesAtOnce * boxesAtOnce;
    const BoxLanes lanes{static_cast<int>(whole),
                         {row(0), row(1), row(2)},
                         {row(3), row(4), row(5)}};
    return kernels.findOverlapping(lanes, box.low, box.high, hits.data());
}

void LeafBoxes::find(const Elements& elements, const BvhLeaf& leaf, std::span<const FloatBox> ofPoints) {
    const auto at = [&](int i) -> const FloatBox& { return ofPoints[static_cast<std::size_t>(i)]; };
    points.clear(leaf.points.size());
    for (int i : leaf.points) points.add(i, at(i));
    triangles.clear(leaf.triangles.size());
    for (int t : leaf.triangles) {
        const Triangle& triangle = elements.triangles()[static_cast<std::size_t>(t)];
        const std::array<int, 3>& c = triangle.points;
        if (!triangle.isGone) triangles.add(t, at(c[0]).joined(at(c[1])).joined(at(c[2])));
    }
    edges.clear(leaf.edges.size());
    for (int e : leaf.edges) {
        const Edge& edge = elements.edges()[static_cast<std::size_t>(e)];
        if (!edge.isGone) edges.add(e, at(edge.a).joined(at(edge.b)));
    }
}

}  // namespace taut::contact
