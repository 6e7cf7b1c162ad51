#include "object_springs.h"

#include <algorithm>
#include <cmath>

namespace taut::bench {

template <class Real>
struct ObjectSprings<Real>::Gravity final : Generator {
    void updateForce(Point& point, Real) override { point.force.y -= point.mass * Real(9.81); }
};

template <class Real>
struct ObjectSprings<Real>::Drag final : Generator {
    void updateForce(Point& point, Real) override {
        const Real c = point.drag * point.mass;
        point.force.x -= c * point.velocity.x;
        point.force.y -= c * point.velocity.y;
        point.force.z -= c * point.velocity.z;
    }
};

// The pull of `other` on the point that it is registered for; the pull back is another object's business.
template <class Real>
struct ObjectSprings<Real>::SpringEnd final : Generator {
    SpringEnd(const Point* o, const mechanics::Spring& s)
        : other(o),
          k(static_cast<Real>(s.stiffness)),
          restLength(static_cast<Real>(s.restLength)),
          c(static_cast<Real>(s.stiffness * s.dampingTime)) {}

    void updateForce(Point& point, Real) override {
        const Real dx = other->position.x - point.position.x, dy = other->position.y - point.position.y,
                   dz = other->position.z - point.position.z;
        const Real l = std::sqrt(dx * dx + dy * dy + dz * dz);
        if (l == Real(0)) return;
        const Real nx = dx / l, ny = dy / l, nz = dz / l;
        const Real rate = (other->velocity.x - point.velocity.x) * nx + (other->velocity.y - point.velocity.y) * ny +
                          (other->velocity.z - point.velocity.z) * nz;
        const Real pull = k * (l - restLength) + c * rate;
        point.force.x += pull * nx;
        point.force.y += pull * ny;
        point.force.z += pull * nz;
    }

    const Point* other;
    Real k, restLength, c;
};

template <class Real>
ObjectSprings<Real>::ObjectSprings(const mechanics::Model& cloth, double step) : h_(static_cast<Real>(step)) {
    for (std::size_t i = 0; i < cloth.positions.size(); ++i) {
        const glm::dvec3& x = cloth.positions[i];
        Point point{};
        point.position = {static_cast<Real>(x.x), static_cast<Real>(x.y), static_cast<Real>(x.z)};
        point.mass = static_cast<Real>(cloth.masses[i]);
        point.inverseMass = cloth.held[i] ? Real(0) : Real(1) / point.mass;
        point.drag = static_cast<Real>(cloth.dragRates[i]);
        points_.push_back(point);
    }
    const auto add = [&](Point& point, std::unique_ptr<Generator> generator) {
        registry_.push_back({&point, generator.get()});
        generators_.push_back(std::move(generator));
    };
    for (Point& point : points_) {
        add(point, std::make_unique<Gravity>());
        add(point, std::make_unique<Drag>());
    }
    for (const mechanics::Spring& s : cloth.springs) {
        Point &a = points_[s.a], &b = points_[s.b];
        add(a, std::make_unique<SpringEnd>(&b, s));
        add(b, std::make_unique<SpringEnd>(&a, s));
    }
}

template <class Real>
void ObjectSprings<Real>::step(int count) {
    for (int i = 0; i < count; ++i) {
        for (Point& p : points_) p.force = {};
        for (const Entry& entry : registry_) entry.generator->updateForce(*entry.point, h_);
        for (Point& p : points_) {
            const Real gain = h_ * p.inverseMass;
            p.velocity.x += gain * p.force.x;
            p.velocity.y += gain * p.force.y;
            p.velocity.z += gain * p.force.z;
            p.position.x += h_ * p.velocity.x;
            p.position.y += h_ * p.velocity.y;
            p.position.z += h_ * p.velocity.z;
        }
    }
}

template <class Real>
double ObjectSprings<Real>::lowestPoint() const {
    double lowest = 0.0;
    for (const Point& p : points_) lowest = std::min(lowest, static_cast<double>(p.position.y));
    return lowest;
}

template class ObjectSprings<float>;
template class ObjectSprings<double>;

}  // namespace taut::bench
