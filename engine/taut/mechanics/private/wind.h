// Air that moves past triangles: drag and lift, steady or in gusts. It knows no cloth, and not the rest of the scene.
//
// Let u be the mean of the air's velocities relative to a triangle's points, n its normal turned along u, A its area:
//
//   F = ½ρA (u·n) [ C_D u + C_L (|u| n - (u·n)/|u| u) ],       a third to each corner.
//
// Across the flow (n ∥ u) this is the flat plate's drag ½ρ A C_D u². At an angle α between plate and flow, drag is
// ∝ A sin α, the area that the flow sees. Lift is at a right angle to u towards n, and is ½ρ A C_L u² sin α cos α.
// Both vanish edge-on. Cloth is edge-on much of the time, and a lift C_L |u|² n would jump there with the sign of n.
//
// Flutter. The air that a stiff plate pushes before it has momentum along the normal only, so a plate that slides at a
// slant is turned broadside (Munk's moment, -m_a w u × n with w along the normal and u along the plate). A plate that
// turns has besides the lift m_a ω × v of thin airfoils (Γ = π/4 c² ω, and m_a = π/4 ρ c of each area). A sheet without
// both glides on as it slants; with them paper swings to and fro as it falls (Andersen, Pesavento and Wang 2005). Let m
// be the air of a triangle, v its velocity less the air's, w = v·n, g_k the gradient of corner k's coordinate, and
// ṅ = -Σ g_k (n·v_k) how the normal turns. Corner k gets
//
//   F_k = -m w (v·g_k) n + ⅓ m (w ṅ - 2 (v·ṅ) n),
//
// which does no work. On a wave of the sheet it acts as an axial load m U²/A would: what is limper than that folds as
// finely as its cells, if nothing draws it taut, for short folds take less air along than m says. So only stiff sheets
// ask for it.
//
// Smoothness. Edge-on, at u·n = 0, the drag's |u·n| has a kink: F is continuous, and its slope jumps by ρA C_D |u|. A
// step across the kink is off by O(h²) in v for any method. So methods of order 4 fall to order 2 once triangles turn
// through the flow or are carried along by it. Methods of order 1 and 2 keep their order. The lift is smooth where u is
// not zero, and gusts are smooth enough for order 4 (noise.h).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/private/index_runs.h"
#include "taut/mechanics/linear_path.h"
#include "taut/mechanics/private/noise.h"
#include "taut/mechanics/private/wind_kernel.h"

namespace taut::mechanics {

struct WindSettings {
    double airDensity = 1.2;  // ρ [kg/m³]
    double drag = 1.0;        // C_D [-]
    double lift = 0.6;        // C_L [-]
    GustField gust;           // added to the steady flow; amplitude 0: no gusts
    // [m/s] Relative speed up to which the damping share holds; 0: twice the fastest air, at least 10 m/s.
    double workingSpeed = 0.0;
    bool operator==(const WindSettings&) const = default;
};

// One flow over a set of triangles. Do not put two winds on the same triangles: each would resist the other. Add their
// velocities instead.
template <class Real>
class Wind final : public ForceGenerator<Real> {
  public:
    using Triangle = std::array<int, 3>;  // points

    // Uses the kernel of the current instruction set.
    Wind(std::span<const Triangle> triangles, const glm::dvec3& velocity, const WindSettings& settings);
    // plateAir (triangles) [kg] makes them flutter; empty: none.
    Wind(std::span<const Triangle> triangles, const LinearPath& velocity, const WindSettings& settings,
         std::span<const double> plateAir = {});

    // The steady flow [m/s]: constant, or changing evenly from `from` to `to` between t0 and t1 [s].
    void setVelocity(const glm::dvec3& velocity) { velocity_ = {velocity, velocity, 0.0, 0.0}; }
    void setVelocity(const glm::dvec3& from, const glm::dvec3& to, double t0, double t1) {
        velocity_ = {from, to, t0, t1};
    }
    void setVelocity(const LinearPath& velocity) { velocity_ = velocity; }
    void setSettings(const WindSettings& settings);
    const WindSettings& settings() const { return settings_; }

    glm::dvec3 airVelocity(const glm::dvec3& x, double t) const;  // [m/s], gust included
    double workingSpeed() const;                                  // [m/s]

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>&, const std::vector<bool>& = {}) const override { return 0.0; }
    void addStiffnessProduct(const Motion<Real>&, const Real*, Real*) const override {}
    // K is left out. Of C it takes the drag's share in the steady flow, ½ρA C_D (|u·n| I + u nᵀ). It replaces u by its
    // part along n in the second term: ½ρA C_D |u·n| (I + nnᵀ) is symmetric and positive. Each pair of corners gets a
    // ninth.
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    // Adds dampingRate at the working speed U, for the areas at the motion's positions.
    // |∂F/∂u| <= ½ρA U (2 C_D + 3/2 C_L): drag has at most 2 (broadside). Lift, in polar terms of u, has
    // √(sin² 2α + cos² 2α) in the plane of u and n, and sin² α across it. Each corner has a third of the force and of
    // the mean velocity, so its row sums to 1/3 of that. Flutter adds m U (2 |g_k| + 5/3 Σ|g|) to corner k.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    void addFlutter(const Motion<Real>& motion, Real* f) const;

    std::vector<Triangle> triangles_;
    std::vector<Real> plateAir_;  // (triangles) [kg]; empty: none
    IndexRuns<3> runs_;
    core::AlignedArray<Real> weight_;  // (lanes) 1, or 0 for a lane without a triangle
    int firstPoint_ = 0, pointCount_ = 0;
    mutable core::AlignedArray<Real> slip_, packed_;  // scratch of the kernel
    LinearPath velocity_;
    WindSettings settings_;
    void (*addBatch_)(const WindBatch<Real>&);
    struct Resistance {
        Real normal[3];  // n
        Real each;       // for a pair of corners
    };
    std::vector<Resistance> resistances_;  // (triangles)
};

extern template class Wind<float>;
extern template class Wind<double>;

}  // namespace taut::mechanics
