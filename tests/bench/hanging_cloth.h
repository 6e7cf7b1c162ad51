// The cloth that the benchmarks step: square, hung from its top row, slightly rippled. It does not know the
// contestants.
#pragma once

#include <memory>

#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/model.h"
#include "taut/ode/method.h"

namespace taut::bench {

// side × side points: structural, shear and bend springs, all with dashpots, and drag.
mechanics::Model hangingCloth(int side);

// The same sheet as a mesh, as one is read from a file: side × side points, each square cut into two triangles this way
// or that, numbered at random and then breadth first, as islands number the points of a mesh.
mechanics::Model hangingMesh(int side);

// A step that is stable for the cloth with dashpots, half the leap-frog limit [s].
double stableStep(const mechanics::Model& cloth);

enum class Air { still, windy };

// The cloth as taut runs it: leap-frog, gravity, and wind on the triangles when asked for.
template <class Real>
class ClothRun {
  public:
    ClothRun(const mechanics::Model& cloth, Air air);
    void step(int count);
    double lowestPoint() const;  // [m], finite as long as the run is

  private:
    double h_;  // [s]
    mechanics::MassSpringSystem<Real> system_;
    std::unique_ptr<ode::Method<Real>> method_;
    ode::State<Real> state_;
};

extern template class ClothRun<float>;
extern template class ClothRun<double>;

}  // namespace taut::bench
