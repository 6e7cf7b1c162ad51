// The tree of boxes over the triangles of a mesh. It knows only boxes, which Bullet makes and rounds outwards to a grid
// of 65 535 steps. The walks over Bullet's nodes are our own: Bullet's writes a global counter, which bodies that are
// resolved in parallel would share, has no way to the nearest triangles first, and takes twice as long.
#pragma once

#include <BulletCollision/BroadphaseCollision/btQuantizedBvh.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <utility>

#include "taut/collision/geometry.h"

namespace taut::collision {

class MeshTree {
  public:
    MeshTree() = default;
    explicit MeshTree(std::span<const dvec3> corners);  // (3 · triangles)

    // Calls see(triangle) for every triangle whose box overlaps the given one, always in the same order.
    template <class Visit>
    void visit(const core::Aabb& box, const Visit& see) const {
        constexpr double rounding = 0.01;
        int low[3], high[3];  // [steps]
        for (int k = 0; k < 3; ++k) {
            const auto inGrid = [&](double x) { return std::clamp((x - from_[k]) / step_[k], -2.0, lastStep + 2.0); };
            low[k] = static_cast<int>(inGrid(box.low[k]) - rounding);
            high[k] = static_cast<int>(inGrid(box.high[k]) + 1.0 + rounding);
        }
        const Node* node = nodes_.data();
        const Node* const end = node + nodes_.size();
        while (node < end) {
            const auto &least = node->m_quantizedAabbMin, &most = node->m_quantizedAabbMax;
            const bool overlaps = least[0] <= high[0] && most[0] >= low[0] && least[1] <= high[1] &&
                                  most[1] >= low[1] && least[2] <= high[2] && most[2] >= low[2];
            if (overlaps && node->isLeafNode()) see(node->getTriangleIndex());
            node += overlaps ? 1 : sizeOf(*node);
        }
    }

    // Calls see(triangle) for every triangle whose box may be nearer to a place than `square` [m²], near ones first.
    // see() lowers `square`. Triangles that are nearer by less than the factor 1 / shrink of the squares may be left
    // out.
    template <class See>
    void closest(const dvec3& place, double shrink, const double& square, const See& see) const {
        struct Open {
            const Node* node;
            double square;
        };
        std::array<Open, 64> open;  // enough, because Bullet's splits leave each side a third at least
        std::size_t count = 0;
        const dvec3 p = (place - from_) / step_;
        Open now{nodes_.data(), squareTo(nodes_[0], p)};
        for (;;) {
            if (now.square * shrink <= square * (1.0 + 1e-9)) {
                if (!now.node->isLeafNode()) {
                    const Node* const left = now.node + 1;
                    const Node* const right = left + sizeOf(*left);
                    now = {left, squareTo(*left, p)};
                    Open other{right, squareTo(*right, p)};
                    if (other.square < now.square) std::swap(now, other);
                    open[count++] = other;
                    continue;
                }
                see(now.node->getTriangleIndex());
            }
            if (count == 0) return;
            now = open[--count];
        }
    }

  private:
    using Node = btQuantizedBvhNode;
    static constexpr unsigned short lastStep = 65535;

    // Of a node and all below it.
    static int sizeOf(const Node& node) { return node.isLeafNode() ? 1 : node.getEscapeIndex(); }
    // [m²] From p [steps] to a box.
    double squareTo(const Node& node, const dvec3& p) const {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double below = node.m_quantizedAabbMin[k] - p[k];
            const double above = p[k] - node.m_quantizedAabbMax[k];
            const double out = step_[k] * (below > above ? below : above);
            sum += out > 0.0 ? out * out : 0.0;
        }
        return sum;
    }

    std::shared_ptr<const btQuantizedBvh> tree_;
    std::span<const Node> nodes_;  // of the tree, depth first
    dvec3 from_{0.0}, step_{1.0};  // [m] of its grid
};

}  // namespace taut::collision
