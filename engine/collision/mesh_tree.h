// The tree of boxes over the triangles of a mesh. Bullet builds it; it is walked here, because Bullet's own walk
// writes a global counter, which bodies that are resolved side by side would share. Knows boxes only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/geometry.h"

namespace taut::collision {

class MeshTree {
  public:
    MeshTree() = default;
    MeshTree(std::span<const dvec3> vertices, std::span<const std::uint32_t> triangles);

    // Calls see(triangle) for every triangle whose box overlaps the given one, always in the same order.
    template <class Visit>
    void visit(const Box& box, const Visit& see) const {
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

  private:
    struct Node {
        float low[3], high[3];  // [m] a little larger than what they hold, so that float is enough
        int triangle;           // below 0: an inner node
        int skip;               // nodes from here to the next that is not below this one
    };
    std::vector<Node> nodes_;  // depth first
};

}  // namespace taut::collision
