// Boxes of the elements of a leaf, in single precision. They are rounded outwards, so that no two that overlap in truth
// are apart here. A kernel tests one box against all boxes of a leaf at once.
#pragma once

#include <bit>
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

// Rounded outwards, and grown by `reach` [m] on all sides.
FloatBox floatBox(const core::Aabb& box, double reach);
// The boxes of points x (points) [m].
void findPointBoxes(std::span<const dvec3> x, std::vector<FloatBox>& boxes);

// Boxes of some elements of a leaf, in rows: all lower x, all lower y, …
class ElementBoxes {
  public:
    // boxOf(item): its box. Keeps a reference to the items.
    template <class BoxOf>
    void fill(const std::vector<int>& items, const BoxOf& boxOf) {
        items_ = items;
        stride_ = (items.size() + boxesAtOnce - 1) / boxesAtOnce * boxesAtOnce;
        rows_.resize(6 * stride_);
        for (std::size_t i = 0; i < stride_; ++i) set(i, i < items.size() ? boxOf(items[i]) : FloatBox::none());
    }
    int item(int i) const { return items_[static_cast<std::size_t>(i)]; }
    FloatBox box(int i, float reach) const;  // grown by the reach [m] on all sides
    // A bit for each box that overlaps this one -> hits. Returns whether there is any.
    bool findHits(const FloatBox& box, const ClosestKernels& kernels, std::vector<std::uint64_t>& hits) const;

  private:
    void set(std::size_t i, const FloatBox& box) {
        float* at = rows_.data() + i;
        for (std::size_t k = 0; k < 3; ++k) {
            at[k * stride_] = box.low[k];
            at[(k + 3) * stride_] = box.high[k];
        }
    }
    const float* row(std::size_t k) const { return rows_.data() + k * stride_; }

    std::span<const int> items_;
    std::vector<float> rows_;  // (6, stride)
    std::size_t stride_ = 0;   // a multiple of boxesAtOnce; the boxes after the last overlap nothing
};

struct LeafBoxes {
    ElementBoxes points, triangles, edges;
    // Keeps references to the leaf.
    void find(const Elements& elements, const BvhLeaf& leaf, std::span<const FloatBox> ofPoints);
};

// Finds the elements of two leaves, or of one with itself, whose boxes come within reach of each other.
class BoxQuery {
  public:
    BoxQuery(const ClosestKernels& kernels, double reach) : kernels_(kernels), reach_(reach) {}

    // Calls each(element of first, element of second). boxOfFirst: of all elements of the leaf of `first`; boxOfSecond
    // likewise. Of one leaf, boxes are paired with those after them.
    template <class Each>
    void forEach(const ElementBoxes& first, const core::Aabb& boxOfFirst, const ElementBoxes& second,
                 const core::Aabb& boxOfSecond, const Each& each) {
        const bool isOne = &first == &second;
        // Elements that may meet any element of the other leaf.
        if (!second.findHits(floatBox(boxOfFirst, reach_), kernels_, seconds_)) return;
        if (isOne)
            firsts_ = seconds_;
        else if (!first.findHits(floatBox(boxOfSecond, reach_), kernels_, firsts_))
            return;
        const auto reach = static_cast<float>(reach_ * (1 + 1e-6));
        forEachBit(firsts_, [&](int i) {
            if (!second.findHits(first.box(i, reach), kernels_, hits_)) return;
            for (std::size_t w = 0; w < hits_.size(); ++w) hits_[w] &= seconds_[w];
            forEachBit(hits_, [&](int j) {
                if (!isOne || j > i) each(first.item(i), second.item(j));
            });
        });
    }

  private:
    template <class Each>
    static void forEachBit(const std::vector<std::uint64_t>& bits, const Each& each) {
        for (std::size_t w = 0; w < bits.size(); ++w)
            for (std::uint64_t left = bits[w]; left != 0; left &= left - 1)
                each(static_cast<int>(64 * w) + std::countr_zero(left));
    }

    const ClosestKernels& kernels_;
    double reach_;
    std::vector<std::uint64_t> firsts_, seconds_, hits_;  // bits
};

}  // namespace taut::contact
