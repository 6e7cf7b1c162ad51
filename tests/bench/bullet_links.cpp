#include "bullet_links.h"

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace taut::bench {

static_assert(sizeof(btScalar) == sizeof(float), "the comparison is with Bullet's usual, single precision build");

struct BulletLinks::Impl {
    btSoftBodyWorldInfo world;
    btSoftBody body{&world};
};

BulletLinks::BulletLinks(const mechanics::Model& cloth, LinkOrder order) : impl_(std::make_unique<Impl>()) {
    btSoftBody& body = impl_->body;
    btSoftBody::Material* material = body.appendMaterial();
    for (std::size_t i = 0; i < cloth.positions.size(); ++i) {
        const glm::vec3 x(cloth.positions[i]);
        body.appendNode({x.x, x.y, x.z}, cloth.held[i] ? 0.0f : static_cast<float>(cloth.masses[i]));
    }
    std::vector<mechanics::Spring> springs = cloth.springs;
    std::stable_sort(springs.begin(), springs.end(), [](const mechanics::Spring& s, const mechanics::Spring& t) {
        return std::min(s.a, s.b) < std::min(t.a, t.b);
    });
    for (std::size_t i = 0; i < springs.size(); ++i) {
        body.appendLink(springs[i].a, springs[i].b, material);
        body.m_links[static_cast<int>(i)].m_rl = static_cast<float>(springs[i].restLength);
    }
    if (order == LinkOrder::reordered) btSoftBodyHelpers::ReoptimizeLinkOrder(&body);
    for (int i = 0; i < body.m_links.size(); ++i) body.m_links[i].m_c1 = body.m_links[i].m_rl * body.m_links[i].m_rl;
    body.updateLinkConstants();
}

BulletLinks::~BulletLinks() = default;

void BulletLinks::iterate(int count) {
    for (int i = 0; i < count; ++i) btSoftBody::PSolve_Links(&impl_->body, 1.0f, 0.0f);
}

double BulletLinks::lowestPoint() const {
    float lowest = std::numeric_limits<float>::max();
    for (int i = 0; i < impl_->body.m_nodes.size(); ++i) lowest = std::min(lowest, impl_->body.m_nodes[i].m_x.y());
    return static_cast<double>(lowest);
}

}  // namespace taut::bench
