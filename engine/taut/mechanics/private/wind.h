// Air that moves past triangles, rods and balls: drag and lift, steady or in gusts. Independent of cloth and
// scene.
//
// Let u be the mean of the air's velocities relative to a triangle's points, n its normal turned along u, A its area:
//
//   F = ½ρA (u·n) [ C_D u + C_L (|u| n - (u·n)/|u| u) ],       a third to each corner.
//
// Across the flow (n ∥ u) this is the flat plate's drag ½ρ A C_D u². At an angle α between plate and flow, drag is
// ∝ A sin α, the area that the flow sees. Lift is at a right angle to u towards n, and is ½ρ A C_L u² sin α cos α.
// Both vanish edge-on. Cloth is edge-on much of the time, and a lift C_L |u|² n would jump there with the sign of n. Of
// a body with an inside each triangle has air on one side only, which is half of a plate's force: its coefficient
// across the flow, front and back, is then C_D again.
//
// A rod has the drag of the flow across it (Hoerner 1965): F = ½ρ C_D 2rL |u⊥| u⊥, half to each end. A ball of area A =
// π r² has F = ½ρ C_D A |u| u.
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
// which does no work. On a wave of the sheet it acts as an axial load m U²/A would: limper sheets fold as
// finely as their cells, if nothing draws them taut, for short folds take less air along than m says. So use it for
// stiff sheets only.
//
// Smoothness. Edge-on, at u·n = 0, the drag's |u·n| has a kink: F is continuous, and its slope jumps by ρA C_D |u|. A
// step across the kink is off by O(h²) in v for any method. So methods of order 4 fall to order 2 once triangles turn
// through the flow or move along with the air. Methods of order 1 and 2 keep their order. The lift is smooth where u is
// not zero, and gusts are smooth enough for order 4 (noise.h).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/linear_path.h"
#include "taut/mechanics/private/index_runs.h"
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

// Surfaces and points in the air; all points belong to a Motion.
struct WindTargets {
    std::vector<std::array<int, 3>> triangles{};
    std::vector<double> sides{};  // (triangles) Areas in the air over that of the triangle: 1, or ½ where it has one
                                  // side there; empty: 1
    std::vector<double> plateAir{};  // (triangles) [kg] makes them flutter; empty: none
    // A rod from a to b, or a ball at a point, which is a and b.
    struct Round {
        int a = 0, b = 0;
        double width = 0;  // [m] of a rod
        double area = 0;   // [m²] of a ball
    };
    std::vector<Round> rounds{};
};

// One flow over a set of targets. Do not put two winds on the same ones: each would resist the other. Add their
// velocities instead.
template <class Real>
class Wind final : public ForceGenerator<Real> {
  public:
    using Triangle = std::array<int, 3>;  // points

    // Uses the kernel of the current instruction set.
    Wind(const WindTargets& targets, const LinearPath& velocity, const WindSettings& settings);
    Wind(std::span<const Triangle> triangles, const glm::dvec3& velocity, const WindSettings& settings);

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
    // ninth. Of a rod it is ½ρ C_D 2rL |u⊥| (I - eeᵀ + u⊥u⊥ᵀ/|u⊥|²), a quarter to each pair of ends.
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    // Adds dampingRate at the working speed U, for the areas at the motion's positions.
    // |∂F/∂u| <= ½ρA U (2 C_D + 3/2 C_L): drag has at most 2 (broadside). Lift, in polar terms of u, has
    // √(sin² 2α + cos² 2α) in the plane of u and n, and sin² α across it. Each corner has a third of the force and of
    // the mean velocity, so its row sums to 1/3 of that; of a rod to ½ of ½ρA U 2 C_D. Flutter adds m U (2 |g_k| + 5/3
    // Σ|g|) to corner k.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    using Round = WindTargets::Round;
    using Vec = glm::vec<3, Real>;

    void addTriangles(const Motion<Real>& motion, Real* f) const;
    void addFlutter(const Motion<Real>& motion, Real* f) const;
    // Of a round target: how it moves through the air [m/s], of a rod across itself, the area that it has across the
    // flow [m²], and the axis of a rod, or 0.
    struct Past {
        Vec u, axis;
        Real area;
    };
    Past past(const Round& round, const Motion<Real>& motion) const;
    static Vec wayAlong(const Round& round, const Motion<Real>& motion);  // [m] from a to b

    std::vector<Triangle> triangles_;
    std::vector<double> sides_;   // (triangles)
    std::vector<Real> plateAir_;  // (triangles) [kg]; empty: none
    std::vector<Round> rounds_;
    IndexRuns<3> runs_;
    core::AlignedArray<Real> weight_;  // (lanes) of the triangle's sides, or 0 for a lane without one
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
    struct RoundResistance {
        Vec axis, along;  // of the rod, and of the flow across it
        Real each;        // for a pair of ends
    };
    std::vector<RoundResistance> roundResistances_;  // (rounds)
};

extern template class Wind<float>;
extern template class Wind<double>;

}  // namespace taut::mechanics
