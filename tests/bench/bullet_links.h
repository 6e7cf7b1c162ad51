// Bullet's soft body with the springs of a model as its links, single precision. Hides every Bullet type.
#pragma once

#include <memory>

#include "taut/mechanics/model.h"

namespace taut::bench {

// byPoint lists the links by their lower point, as Bullet's own patch builder does: kindest to the cache.
// reordered is Bullet's ReoptimizeLinkOrder on top, which moves links apart that wait for each other's points.
enum class LinkOrder { byPoint, reordered };

class BulletLinks {
  public:
    BulletLinks(const mechanics::Model& cloth, LinkOrder order);
    ~BulletLinks();
    BulletLinks(const BulletLinks&) = delete;
    BulletLinks& operator=(const BulletLinks&) = delete;

    // PSolve_Links: each link once, one after the other. No forces, no integration, no dashpots.
    void iterate(int count);
    double lowestPoint() const;  // [m]

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::bench
