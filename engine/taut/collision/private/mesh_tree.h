// The tree of boxes over the triangles of a mesh. It knows only boxes. Bullet builds it. This is a copy, as Bullet's own
// tree cannot take its place:
// - Its walk writes a global counter, which bodies that are resolved in parallel would share.
// - It has no walk to the nearest triangles first.
// - In a mesh of 82 000 triangles it takes 860 ns to find those in a box of 1 cm, 2.7 µs in one of 4 cm. This walk takes
//   460 ns and 1.2 µs.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

class MeshTree {
  public:
    MeshTree() = default;
    explicit MeshTree(std::span<const dvec3> corners);  // (3 · triangles)

    // Calls see(triangle) for every triangle whose box overlaps the given one, always in the same order.
    template <class Visit>
    void visit(const core::Aabb& box, const Visit& see) const {
        float low[3];
        float high[3];
        for (int k = 0; k < 3; ++k) {
            low[k] = static_cast<float>(box.low[k]);
            high[k] = static_cast<float>(box.high[k]);
        }
        const Node* node = nodes_.data();
        const Node* const end = node + nodes_.size();
        while (node < end) {
            const bool overlaps = node->low[0] <= high[0] && node->high[0] >= low[0] && node->low[1] <= high[1] &&
                                  node->high[1] >= low[1] && node->low[2] <= high[2] && node->high[2] >= low[2];
            if (node->triangle >= 0) {
                if (overlaps) see(node->triangle);
                ++node;
            } else {
                node += overlaps ? 1 : node->skip;
            }
        }
    }

    // Calls see(triangle) for every triangle whose box may be nearer to p than `square` [m²], near ones first. see()
    // lowers `square`. Triangles that are nearer by less than the factor 1 / shrink of the squares may be left out.
    template <class See>
    void closest(const dvec3& p, double shrink, const double& square, const See& see) const {
        struct Open {
            const Node* node;
            double square;
        };
        std::array<Open, 64> open;  // enough, because Bullet's splits leave each side a third at least
        std::size_t count = 0;
        Open now{nodes_.data(), squareTo(nodes_[0], p)};
        for (;;) {
            if (now.square * shrink <= square * (1.0 + 1e-9)) {
                if (now.node->triangle < 0) {
                    const Node* const left = now.node + 1;
                    const Node* const right = left + left->skip;
                    now = {left, squareTo(*left, p)};
                    Open other{right, squareTo(*right, p)};
                    if (other.square < now.square) std::swap(now, other);
                    open[count++] = other;
                    continue;
                }
                see(now.node->triangle);
            }
            if (count == 0) return;
            now = open[--count];
        }
    }

  private:
    struct Node {
        float low[3], high[3];  // [m] a little larger than the contents, so that float is enough
        int triangle;           // below 0: an inner node
        int skip;               // number of nodes from here to the next one that is not below this one
    };

    // [m²] from p to a box.
    static double squareTo(const Node& node, const dvec3& p) {
        double sum = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double below = node.low[k] - p[k];
            const double above = p[k] - node.high[k];
            const double out = below > above ? below : above;
            sum += out > 0.0 ? out * out : 0.0;
        }
        return sum;
    }

    std::vector<Node> nodes_;  // depth first
};

}  // namespace taut::collision
