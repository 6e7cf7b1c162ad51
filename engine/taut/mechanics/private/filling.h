// A gas or a liquid in closed surfaces that presses on them from within. Independent of cloth.
//
// A chamber is a surface without an edge; V is the volume that it encloses, Δp its pressure above that of the air
// outside. A triangle a b c gets the force Δp ½ (b - a) × (c - a), a third to each corner. On a surface without an edge
// that is Δp ∂V/∂x of each point exactly, without any sum of forces or torques.
//
//   keeps      Δp                           potential energy
//   pressure   P                            -P V                                  a pump
//   amount     (p₁ + P) V₀/V - p₀           p₀ (V - V₀) - (p₁ + P) V₀ ln(V/V₀)    a sealed gas, as warm as the air
//   volume     P + K (1 - V/V₀)             ½ K (V - V₀)²/V₀ - P V                a liquid
//
// P is the pressure at the first volume V₀, p₀ that of the air outside, p₁ that pressure when the gas was sealed in, K
// a bulk modulus. Below V₀/1000 a gas presses as it does there. A pump that sucks, P < 0, does so less below V₀/10, in
// proportion, and not where V <= 0: it turns nothing inside out.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/linear_path.h"

namespace taut::mechanics {

enum class FillingKeeps { pressure, amount, volume };

struct FillingLaw {
    FillingKeeps keeps = FillingKeeps::pressure;
    double outside = 101325.0;   // p₀ [Pa]
    double sealedIn = 101325.0;  // p₁ [Pa]
    double bulkModulus = 1e6;    // K [Pa]
    bool operator==(const FillingLaw&) const = default;
};

// A part of a surface that hangs together by edges.
struct Chamber {
    std::vector<std::array<int, 3>> triangles;  // turned alike
    double firstVolume = 0;                     // V₀ [m³] >= 0
    int openEdges = 0;                          // edges that have not two triangles
    bool isTwisted = false;                     // its triangles cannot be turned alike
    bool isClosed() const { return openEdges == 0 && !isTwisted; }
};

// The chambers of triangles, whose points are at places (points) [m]. Points that are `one` (points) are the same point
// to the surface; empty: each its own. Triangles on the same three points, or on two, enclose nothing. The others are
// turned so that the volume is positive; where it is none, as most of them are. Gaps between points that are one, which
// are not in one place yet, are closed by further triangles, so that there is no sum of forces then either.
std::vector<Chamber> chambersOf(std::span<const std::array<int, 3>> triangles, std::span<const glm::dvec3> places,
                                std::span<const int> one = {});

template <class Real>
class Filling final : public ForceGenerator<Real> {
  public:
    // Expects closed chambers, and with a volume unless it keeps the pressure.
    Filling(std::vector<Chamber> chambers, std::span<const glm::dvec3> places, const FillingLaw& law,
            const LinearPathOf<double>& pressure);

    void setPressure(const LinearPathOf<double>& pressure) { pressure_ = pressure; }  // P [Pa]

    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    // The exact product: -dΔp/dV g gᵀ - Δp ∂²V/∂x², g = ∂V/∂x.
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    // -dΔp/dV g gᵀ, which is never negative.
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    // -dΔp/dV g gᵀ has one eigenvalue, -dΔp/dV Σ w g²; |g| is no more than a third of the areas around a point. Of Δp
    // ∂²V/∂x² a row sums to no more than Δp/6 of the perimeters around a point. Both hold while edges are at most 1.2
    // times and areas at most 1.44 times their initial values, a gas fills two thirds of V₀ or more, and a liquid keeps
    // its volume.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    struct State {
        double excess = 0;  // Δp [Pa]
        double slope = 0;   // -dΔp/dV [Pa/m³] >= 0
    };
    State stateOf(const Chamber& chamber, double volume, double t) const;
    double volumeOf(const Chamber& chamber, const Motion<Real>& motion) const;

    std::vector<Chamber> chambers_;
    std::vector<glm::dvec3> places_;  // (points) [m] at first
    FillingLaw law_;
    LinearPathOf<double> pressure_;  // [Pa]
    struct Slope {
        std::vector<int> points;
        std::vector<Real> of;  // (3 · points) √(stiffness · slope) g, point by point
    };
    std::vector<Slope> slopes_;              // (chambers) as linearise() found them
    mutable std::vector<glm::dvec3> areas_;  // (triangles) scratch
};

extern template class Filling<float>;
extern template class Filling<double>;

}  // namespace taut::mechanics
