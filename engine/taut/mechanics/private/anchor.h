// Springs, each with a dashpot, from points to a place that may move. A hand holds cloth by those of no length.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "taut/mechanics/force_generator.h"
#include "taut/mechanics/pose_path.h"

namespace taut::mechanics {

// The force on a point is F = -k (x - p) - c (v - ṗ). p is the place at the time plus the point's own offset, which
// turns with the place. If there is a largest force, a longer force is cut to that length. The cut is a projection onto
// a ball, which is monotone. So the slopes of F are no steeper than without it. With U = ∫ min(k d, most) dd,
// d = |x - p|, the dashpot still takes energy and never adds any.
//
// With a length L, F = -(k (d - L) + c ḋ) n along n = (x - p)/d. Its stiffness is k n nᵀ + k (1 - L/d)(1 - n nᵀ), where
// slopes leave out the second part if it is negative.
template <class Real>
class Anchor final : public ForceGenerator<Real> {
  public:
    // stiffness k [N/m] and damping c [kg/s] of every point, >= 0. Offsets (points) [m] keep the points of a grip
    // apart; without offsets all are drawn to the place itself. Expects different points.
    Anchor(std::vector<int> points, const glm::dvec3& place, double stiffness, double damping,
           std::vector<glm::dvec3> offsets = {});
    // The same with a k and c for each point (points), and for each point the largest force [N] > 0 or the length [m]
    // >= 0, or neither (points).
    Anchor(std::vector<int> points, const glm::dvec3& place, std::vector<double> stiffness, std::vector<double> damping,
           std::vector<glm::dvec3> offsets = {}, std::vector<double> most = {}, std::vector<double> lengths = {});

    // The place stays, moves evenly from `from` to `to` between t0 and t1 [s], or follows the path.
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
    // Adds k and c/m of each point. Both hold at any places.
    void addStability(const Motion<Real>& motion, StabilityShare& share) const override;

  private:
    // How the force changes with that of a spring without length or largest force: by `share` across a direction, and
    // by `alongShare` along it.
    struct Slope {
        double share = 1.0;
        glm::dvec3 along{0.0};  // unit; 0: the force is that one
        double alongShare = 0.0;
    };

    glm::dvec3 pull(const Motion<Real>& motion, const PosePath::Frame& frame, std::size_t p) const;  // before the cut
    Slope slope(const Motion<Real>& motion, const PosePath::Frame& frame, std::size_t p) const;
    Slope cut(const glm::dvec3& pull, std::size_t p) const;
    glm::dvec3 away(const Motion<Real>& motion, const PosePath::Frame& frame,
                    std::size_t p) const;                 // [m] from its place
    double energy(std::size_t p, double distance) const;  // [J]
    // Adds weight · slope · u of one point to out.
    void addProduct(std::size_t p, Real weight, const Slope& slope, int stride, const Real* u, Real* out) const;

    std::vector<int> points_;
    std::vector<glm::dvec3> offsets_;  // (points) [m]
    PosePath path_;
    std::vector<double> stiffness_, damping_;  // (points) [N/m], [kg/s]
    std::vector<double> most_;                 // (points) [N]; empty: nothing is cut
    std::vector<double> lengths_;              // (points) [m]; empty: none has any
    std::vector<Real> weight_;                 // (points) s k + d c for the s and d of linearise()
    std::vector<Slope> slopes_;                // (points) at the configuration of linearise()
};

extern template class Anchor<float>;
extern template class Anchor<double>;

}  // namespace taut::mechanics
