// A cloth as textbooks write it: one object a spring end, its force through a virtual call, points as structures.
// The reference for taut's runs of springs.
#pragma once

#include <memory>
#include <vector>

#include "taut/mechanics/model.h"

namespace taut::bench {

template <class Real>
class ObjectSprings {
  public:
    // Drag, gravity and dashpots as in the model; symplectic Euler, the cheapest update.
    ObjectSprings(const mechanics::Model& cloth, double step);
    void step(int count);
    double lowestPoint() const;  // [m]

  private:
    struct Vector {
        Real x, y, z;
    };
    struct Point {
        Vector position, velocity, force;
        Real mass, inverseMass, drag;
    };
    struct Generator {
        virtual ~Generator() = default;
        virtual void updateForce(Point& point, Real h) = 0;
    };
    struct Gravity;
    struct Drag;
    struct SpringEnd;
    // One line of the registry: which generator acts on which point.
    struct Entry {
        Point* point;
        Generator* generator;
    };

    Real h_;
    std::vector<Point> points_;
    std::vector<std::unique_ptr<Generator>> generators_;
    std::vector<Entry> registry_;
};

extern template class ObjectSprings<float>;
extern template class ObjectSprings<double>;

}  // namespace taut::bench
