// Boxes of the elements of a leaf and of their ways, in single precision. They are rounded outwards, so that no two
// that overlap in truth are apart here. A kernel tests one box against all boxes of a leaf at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "taut/contact/bvh.h"
#include "taut/contact/closest_kernel.h"

namespace taut::contact {

// [m] Four numbers, so that they fill a register; the last counts for nothing.
struct alignas(32) FloatBox {
    float low[4], high[4];

    // It overlaps nothing.
    static FloatBox none() {
        constexpr float far = std::numeric_limits<float>::infinity();
        return {{far, far, far, far}, {-far, -far, -far, -far}};
    }
    FloatBox joined(const FloatBox& other) const {
        FloatBox both;
        for (int k = 0; k < 4; ++k) {
            both.low[k] = low[k] < other.low[k] ? low[k] : other.low[k];
            both.high[k] = high[k] > other.high[k] ? high[k] : other.high[k];
        }
        return both;
    }
};

// Rounded outwards.
FloatBox floatBox(const core::Aabb& box);

// Boxes of some elements of a leaf, in rows: all lower x, all lower y, …
class ElementBoxes {
  public:
    // boxOf(item): its box. Keeps a reference to the items.
    template <class BoxOf>
    void fill(const std::vector<int>& items, const BoxOf& boxOf) {
        items_ = items;
        stride_ = std::max<std::size_t>(1, (items.size() + boxesAtOnce - 1) / boxesAtOnce) * boxesAtOnce;
        rows_.resize(6 * stride_ / boxesAtOnce);
        for (std::size_t i = 0; i < stride_; ++i) set(i, i < items.size() ? boxOf(items[i]) : FloatBox::none());
    }
    const int* items() const { return items_.data(); }
    BoxLanes lanes() const { return {static_cast<int>(stride_), {row(0), row(1), row(2)}, {row(3), row(4), row(5)}}; }
    // A bit for each box that overlaps this one -> hits. Returns whether there is any.
    bool findHits(const FloatBox& box, const ClosestKernels& kernels, std::vector<std::uint64_t>& hits) const;

  private:
    void set(std::size_t i, const FloatBox& box) {
        const auto at = [&](std::size_t k) -> float& {
            return rows_[k * (stride_ / boxesAtOnce) + i / boxesAtOnce].of[i % boxesAtOnce];
        };
        for (std::size_t k = 0; k < 3; ++k) {
            at(k) = box.low[k];
            at(k + 3) = box.high[k];
        }
    }
    const float* row(std::size_t k) const { return rows_[k * (stride_ / boxesAtOnce)].of; }

    std::span<const int> items_;
    struct alignas(64) Some {
        float of[boxesAtOnce];
    };
    std::vector<Some> rows_;  // (6, stride / boxesAtOnce)
    std::size_t stride_ = 0;  // a multiple of boxesAtOnce; the boxes after the last overlap nothing
};

struct LeafBoxes {
    core::Aabb whole;  // [m] of all of them
    ElementBoxes points, triangles, edges;
    // On straight ways from x0 to x1 (points) [m], beside the `way` [m] that all go. Keeps references to the leaf.
    void find(const Elements& elements, const BvhLeaf& leaf, std::span<const dvec3> x0, std::span<const dvec3> x1,
              const dvec3& way);
};

// Finds the elements of two leaves, or of one with itself, whose boxes come within reach of each other.
class BoxQuery {
  public:
    // reach [m]. wholeFirst, wholeSecond: the boxes of the two leaves. way [m]: displacement of the first leaf relative
    // to the second. If both sets are the same, each pair is found once. The next call overwrites the result.
    std::span<const ElementPair> find(double reach, const ElementBoxes& first, const core::Aabb& wholeFirst,
                                      const ElementBoxes& second, const core::Aabb& wholeSecond, const dvec3& way);

  private:
    std::vector<std::uint64_t> firsts_, seconds_;  // bits
    std::vector<ElementPair> found_;
};

}  // namespace taut::contact
