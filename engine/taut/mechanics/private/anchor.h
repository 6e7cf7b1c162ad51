// Springs of zero rest length, with a dashpot, from points to a place that may move. A hand holds cloth by them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/pose_path.h"

namespace taut::mechanics {

// On a point: F = -k (x - p) - c (v - ṗ), p the place at the time plus the point's own offset from it, which turns with
// the place if that turns. Where a largest force is said, what is longer is cut to that length. That projects onto a
// ball, which is monotone: the slopes of F are no steeper than without, and with U = ∫ min(k d, most) dd, d = |x - p|,
// the dashpot still takes energy and never adds any.
template <class Real>
class Anchor final : public ForceGenerator<Real> {
  public:
    // stiffness k [N/m] and damping c [kg/s] of every point, >= 0. Offsets (points) [m] keep the points of a grip
    // apart; none: all are drawn to the place itself. Expects different points.
    Anchor(std::vector<int> points, const glm::dvec3& place, double stiffness, double damping,
           std::vector<glm::dvec3> offsets = {});
    // The same with k and c of each point for itself (points), and the largest force on each (points) [N] > 0, if any.
    Anchor(std::vector<int> points, const glm::dvec3& place, std::vector<double> stiffness, std::vector<double> damping,
           std::vector<glm::dvec3> offsets = {}, std::vector<double> most = {});

    // The place stays, moves evenly from one to the other between t0 and t1 [s], or as the path says.
    void setPlace(const glm::dvec3& place) { path_ = LinearPath{place, place, 0.0, 0.0}; }
    void setPlace(const glm::dvec3& from, const glm::dvec3& to, double t0, double t1) {
        path_ = LinearPath{from, to, t0, t1};
    }
    void setPlace(const PosePath& path) { path_ = path; }
    glm::dvec3 place(double t) const { return path_.place.at(t); }

    const std::vector<int>& points() const { return points_; }  // ascending

    bool isLocal() const override { return true; }
    void addForces(const Motion<Real>& motion, int first, int last, Real* f) const override;
    double potentialEnergy(const Motion<Real>& motion, const std::vector<bool>& only = {}) const override;
    void addStiffnessProduct(const Motion<Real>& motion, const Real* u, Real* out) const override;
    void linearise(const Motion<Real>& motion, double stiffness, double damping) override;
    void addProduct(int stride, const Real* u, Real* out) const override;
    void addDiagonal(int stride, Real* out) const override;
    // k, and c/m of each point; both hold anywhere.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    // How a force that is cut changes with the one before: by `share`, and not along it.
    struct Slope {
        double share = 1.0;
        glm::dvec3 along{0.0};  // unit; 0 where nothing is cut
    };

    glm::dvec3 pull(const Motion<Real>& motion, const PosePath::Frame& frame, std::size_t p) const;  // before it is cut
    Slope slope(const glm::dvec3& pull, std::size_t p) const;
    double energy(std::size_t p, double distance) const;  // [J] of one that may be cut
    // Adds weight · slope · u of one point.
    void addProduct(std::size_t p, Real weight, const Slope& slope, int stride, const Real* u, Real* out) const;

    std::vector<int> points_;
    std::vector<glm::dvec3> offsets_;  // (points) [m]
    PosePath path_;
    std::vector<double> stiffness_, damping_;  // (points) [N/m], [kg/s]
    std::vector<double> most_;                 // (points) [N]; empty: nothing is cut
    std::vector<Real> weight_;                 // (points) s k + d c for the s and d of linearise()
    std::vector<Slope> slopes_;                // (points) there
};

extern template class Anchor<float>;
extern template class Anchor<double>;

}  // namespace taut::mechanics
