#include "taut/contact/leaf_boxes.h"

#include <array>
#include <cmath>

namespace taut::contact {

FloatBox floatBox(const core::Aabb& box) {
    constexpr double outwards = 2e-7;  // at least as far out as the number, whichever way it was rounded

    FloatBox own{};
    for (int k = 0; k < 3; ++k) {
        own.low[k] = static_cast<float>(box.low[k] - outwards * std::abs(box.low[k]));
        own.high[k] = static_cast<float>(box.high[k] + outwards * std::abs(box.high[k]));
    }
    return own;
}

bool ElementBoxes::findHits(const FloatBox& box, const ClosestKernels& kernels,
                            std::vector<std::uint64_t>& hits) const {
    hits.resize((stride_ + 63) / 64);
    return kernels.findOverlapping(lanes(), box.low, box.high, hits.data());
}

std::span<const ElementPair> BoxQuery::find(double reach, const ElementBoxes& first, const core::Aabb& wholeFirst,
                                            const ElementBoxes& second, const core::Aabb& wholeSecond,
                                            const dvec3& way) {
    const ClosestKernels kernels = closestKernels();
    const core::Aabb by{glm::min(way, dvec3(0.0)) - reach, glm::max(way, dvec3(0.0)) + reach};
    // Elements that may meet any element of the other leaf.
    if (!second.findHits(floatBox({wholeFirst.low + by.low, wholeFirst.high + by.high}), kernels, seconds_)) return {};
    const bool areOne = &first == &second;
    if (areOne)
        firsts_ = seconds_;
    else if (!first.findHits(floatBox({wholeSecond.low - by.high, wholeSecond.high - by.low}), kernels, firsts_))
        return {};
    BoxSets sets{first.lanes(), second.lanes(), first.items(), second.items(), firsts_.data(), seconds_.data(), {}, {},
                 areOne};
    const FloatBox out = floatBox(by);
    for (int k = 0; k < 3; ++k) {
        sets.low[k] = out.low[k];
        sets.high[k] = out.high[k];
    }
    std::size_t count = 0;
    for (std::size_t word = 0; word < firsts_.size(); ++word) {
        found_.resize(std::max(found_.size(), count + 64 * static_cast<std::size_t>(sets.second.n)));
        count += static_cast<std::size_t>(kernels.findPairs(sets, static_cast<int>(word), found_.data() + count));
    }
    return std::span(found_).first(count);
}

void LeafBoxes::find(const Elements& elements, const BvhLeaf& leaf, std::span<const dvec3> x0,
                     std::span<const dvec3> x1, const dvec3& way) {
    thread_local std::vector<FloatBox> ofPoints;
    ofPoints.resize(std::max(ofPoints.size(), x0.size()));
    whole = {};
    for (int point : leaf.corners) {
        const auto i = static_cast<std::size_t>(point);
        core::Aabb own;
        own.add(x0[i]);
        own.add(x1[i] - way);
        whole.add(own);
        ofPoints[i] = floatBox(own);
    }
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
