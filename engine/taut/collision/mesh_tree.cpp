#include "taut/collision/private/mesh_tree.h"

#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <numeric>
#include <vector>

#include "taut/collision/private/bullet_convex.h"

namespace taut::collision {

MeshTree::MeshTree(std::span<const dvec3> corners) {
    core::Aabb box;
    std::vector<double> places;
    places.reserve(3 * corners.size());
    for (const dvec3& corner : corners) {
        box.add(corner);
        for (int k = 0; k < 3; ++k) places.push_back(Convex::unit * corner[k]);
    }
    std::vector<int> numbers(corners.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const int count = static_cast<int>(corners.size() / 3);
    btTriangleIndexVertexArray arrays(count, numbers.data(), 3 * static_cast<int>(sizeof(int)),
                                      static_cast<int>(corners.size()), places.data(),
                                      3 * static_cast<int>(sizeof(double)));
    const std::shared_ptr<btOptimizedBvh> tree(new btOptimizedBvh);  // aligned by Bullet
    tree->build(&arrays, true, toBullet(box.low), toBullet(box.high));
    nodes_ = {&tree->getQuantizedNodeArray()[0], static_cast<std::size_t>(2 * count - 1)};
    const unsigned short first[3] = {0, 0, 0}, last[3] = {lastStep, lastStep, lastStep};
    from_ = fromBullet(tree->unQuantize(first));
    step_ = (fromBullet(tree->unQuantize(last)) - from_) / static_cast<double>(lastStep);
    tree_ = tree;
}

}  // namespace taut::collision
