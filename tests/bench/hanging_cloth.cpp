#include "hanging_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "taut/mechanics/builders.h"
#include "taut/mechanics/gravity.h"
#include "taut/mechanics/private/stability.h"
#include "taut/mechanics/private/wind.h"
#include "taut/ode/method_table.h"

namespace taut::bench {
namespace {

template <class Real>
mechanics::MassSpringSystem<Real> systemOf(const mechanics::Model& cloth) {
    std::vector<typename mechanics::MassSpringSystem<Real>::PointMass> points;
    for (std::size_t i = 0; i < cloth.masses.size(); ++i)
        points.push_back({cloth.masses[i], cloth.dragRates[i], static_cast<bool>(cloth.held[i])});
    const typename mechanics::MassSpringSystem<Real>::Body body{0, cloth.grid[0] + 1};
    return {points, {&body, 1}, cloth.springs};
}

}  // namespace

mechanics::Model hangingCloth(int side) {
    mechanics::ClothShape shape;
    shape.cells = {side - 1, side - 1};
    shape.material.bend = 2.0;
    shape.material.dampingTime = 1e-6;
    shape.material.dragRate = 0.5;
    mechanics::Model cloth = mechanics::buildCloth(shape);
    for (int p : cloth.groups.at("top")) cloth.held[p] = true;
    for (std::size_t i = 0; i < cloth.positions.size(); ++i)
        cloth.positions[i].z = 0.01 * std::sin(9.0 * cloth.uv[i].x + 4.0 * cloth.uv[i].y) * cloth.uv[i].y;
    return cloth;
}

mechanics::Model hangingMesh(int side) {
    const mechanics::Model sheet = hangingCloth(side);
    const std::size_t count = sheet.positions.size();
    std::mt19937 random(1);
    std::vector<std::array<int, 3>> triangles;
    std::vector<std::vector<int>> neighbours(count);
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i) {
            const int a = j * side + i, b = a + 1, c = b + side, d = a + side;
            if (random() % 2 == 0)
                triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
            else
                triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
            for (const int from : {a, b, c, d})
                for (const int to : {a, b, c, d})
                    if (from != to) neighbours[from].push_back(to);
        }
    std::vector<int> order{0}, numberOf(count, -1);
    numberOf[0] = 0;
    for (std::size_t next = 0; next < order.size(); ++next) {
        std::vector<int>& around = neighbours[order[next]];
        std::shuffle(around.begin(), around.end(), random);
        for (const int i : around) {
            int& number = numberOf[i];
            if (number >= 0) continue;
            number = static_cast<int>(order.size());
            order.push_back(i);
        }
    }
    mechanics::MeshClothShape shape;
    shape.material.bend = 2.0;
    shape.material.dampingTime = 1e-6;
    shape.material.dragRate = 0.5;
    for (const int i : order) shape.positions.push_back(sheet.positions[i]);
    for (const auto& corners : triangles) {
        auto& t = shape.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) t[i] = numberOf[corners[i]];
    }
    mechanics::Model cloth = mechanics::buildMeshCloth(shape);
    for (int p : cloth.groups.at("top")) cloth.held[p] = true;
    return cloth;
}

double stableStep(const mechanics::Model& cloth) {
    std::vector<double> inverseMasses;
    for (std::size_t i = 0; i < cloth.masses.size(); ++i)
        inverseMasses.push_back(cloth.held[i] ? 0.0 : 1.0 / cloth.masses[i]);
    ode::FastestMode mode;
    mode.omega = mechanics::boundAnywhere({cloth.springs, inverseMasses}, {}).omega;
    for (const mechanics::Spring& s : cloth.springs) mode.tau = std::max(mode.tau, s.dampingTime);
    return 0.5 * ode::findMethod("leapfrog")->largestStep(mode);
}

template <class Real>
ClothRun<Real>::ClothRun(const mechanics::Model& cloth, Air air)
    : h_(stableStep(cloth)),
      system_(systemOf<Real>(cloth)),
      method_(ode::makeMethod<Real>("leapfrog")),
      state_(system_.layout()) {
    system_.add(std::make_unique<mechanics::Gravity<Real>>(glm::dvec3(0.0, -9.81, 0.0)));
    if (air == Air::windy)
        system_.add(std::make_unique<mechanics::Wind<Real>>(cloth.triangles, glm::dvec3(1.0, 0.0, 3.0),
                                                            mechanics::WindSettings{}));
    const auto stride = static_cast<std::size_t>(state_.layout.stride);
    for (std::size_t i = 0; i < cloth.positions.size(); ++i)
        for (std::size_t p = 0; p < 3; ++p)
            state_.x[p * stride + i] = static_cast<Real>(cloth.positions[i][static_cast<glm::length_t>(p)]);
    method_->start(system_, 0.0, h_, state_);
}

template <class Real>
void ClothRun<Real>::step(int count) {
    for (int i = 0; i < count; ++i) method_->step(system_, 0.0, h_, state_);
}

template <class Real>
double ClothRun<Real>::lowestPoint() const {
    const Real* y = state_.x.data() + state_.layout.stride;
    return static_cast<double>(*std::min_element(y, y + state_.layout.count));
}

template class ClothRun<float>;
template class ClothRun<double>;

}  // namespace taut::bench
