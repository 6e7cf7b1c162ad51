#include "taut/collision/private/mesh_tree.h"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <algorithm>
#include <numeric>

namespace taut::collision {

MeshTree::MeshTree(std::span<const dvec3> corners) {
    // Bullet builds the tree.
    std::vector<double> places;
    places.reserve(3 * corners.size());
    for (const dvec3& corner : corners) places.insert(places.end(), {corner.x, corner.y, corner.z});
    std::vector<int> numbers(corners.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const int count = static_cast<int>(corners.size() / 3);
    btTriangleIndexVertexArray arrays(count, numbers.data(), 3 * static_cast<int>(sizeof(int)),
                                      static_cast<int>(corners.size()), places.data(),
                                      3 * static_cast<int>(sizeof(double)));
    btBvhTriangleMeshShape shape(&arrays, true);
    const auto& built = shape.getOptimizedBvh()->getQuantizedNodeArray();

    // Bullet rounds its boxes to a grid. This tree keeps Bullet's order but makes exact boxes, from the leaves up.
    const int size = count == 1 ? 1 : 2 * count - 1;
    nodes_.resize(static_cast<std::size_t>(size));
    for (int i = size - 1; i >= 0; --i) {
        Node& node = nodes_[static_cast<std::size_t>(i)];
        if (built[i].isLeafNode()) {
            node.triangle = built[i].getTriangleIndex();
            node.skip = 1;
            core::Aabb box;
            for (int k = 0; k < 3; ++k) box.add(corners[static_cast<std::size_t>(3 * node.triangle + k)]);
            const dvec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
            box.grow(1e-6 * (largest.x + largest.y + largest.z) + 1e-30);
            for (int k = 0; k < 3; ++k) {
                node.low[k] = static_cast<float>(box.low[k]);
                node.high[k] = static_cast<float>(box.high[k]);
            }
        } else {
            const Node& left = nodes_[static_cast<std::size_t>(i + 1)];
            const Node& right = nodes_[static_cast<std::size_t>(i + 1 + left.skip)];
            node.triangle = -1;
            node.skip = 1 + left.skip + right.skip;
            for (int k = 0; k < 3; ++k) {
                node.low[k] = std::min(left.low[k], right.low[k]);
                node.high[k] = std::max(left.high[k], right.high[k]);
            }
        }
    }
}

}  // namespace taut::collision
