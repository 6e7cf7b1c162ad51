// Constraints that hold points of rigid bodies together or at a distance, in pairs, solved for all bodies at once.
//
//     a body k moves by      δ(r) = F/m + (I⁻¹ Σ r × f) × r        f  impulses at its points, F their sum
//     a pair (a, b) holds    δ(a) - δ(b) = x_b - x_a               f  +p at a, -p at b
//     a rod of length L      n·(δ(a) - δ(b)) = (L² - d²) / 2L      p  along n, d = |x_a - x_b|
//
// In turns a pin would move one point of little mass, and its body by that share alone: chains and heavy loads do not
// settle so. Here the impulses p of all pairs solve one symmetric system, A p = x_b - x_a, by conjugate gradients. It
// is the linear part of the motion, so a few solves follow each other. A pin of two bodies already fixes the
// distance of any other place from it, so the second pin of a hinge acts across the axle only. A slider is pins that
// never act along its axis: two on it and one beside it leave five rows. Points get p over their own mass, from which
// their bodies find theirs. This adds no momentum.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <vector>

#include "taut/body/spot.h"
#include "taut/core/rigid_motion.h"

namespace taut::world {

class JoinedBodies {
  public:
    using dvec3 = glm::dvec3;
    using Line = std::array<Spot, 2>;
    struct Pair {
        Spot a, b;
        std::size_t pull;  // for the owner
        double length;     // [m] of a rod; 0: both are in one place
        bool isMost;       // of the length: it is a rod only if it is too long
        // Two spots of a's body: b is held on the line through them, and a is the place on it where b was.
        std::optional<Line> line{};
        dvec3 free{0.0};  // unit, along the line
        // The gap from a to b. values (points): places [m] or velocities.
        dvec3 open(std::span<const dvec3> values, bool arePlaces) const;
    };
    // The place on a line that is nearest to b, x (points) [m].
    static Spot footOf(const Line& line, const Spot& b, std::span<const dvec3> x);

    // points: how many there are.
    void begin(std::size_t points);
    // Points that are of several bodies count for the first.
    void addBody(const core::RigidMotion& body, std::span<const std::size_t> points);
    void addPair(const Pair& pair) { pairs_.push_back(pair); }
    // Holds b on a line, where impulses act at x (points) [m].
    void addSliding(const Line& line, const Spot& b, std::size_t pull, std::span<const dvec3> x);
    bool isEmpty() const;  // no pair holds a body
    bool hasLeash() const {
        return std::any_of(
            pairs_.begin(), pairs_.end(), [](const Pair& pair) { return pair.isMost; });
    }

    // at (points) [m] where impulses act; inverseMass (points) [1/kg]. Returns false if all pairs hold to `settled` of
    // values (points), which are places or velocities; else finds impulses.
    bool solve(std::span<const glm::dvec3> at, std::span<const double> inverseMass, std::span<const glm::dvec3> values,
               bool arePlaces, double settled);
    // ω² [1/s²] for the step, at most, under these forces of the pairs [N]. A force F on an arm r draws its body back
    // like a spring of F r against the inertia across r. A step that turns a body by θ has the momentum of sin θ
    // (mechanics/rigid.h), so none has more than that of a quarter turn, and θ is off by θ²/6: to the step a spin is a
    // spring that it has to follow closely.
    double turning(std::span<const glm::dvec3> at, std::span<const double> forces) const;
    std::span<const Pair> pairs() const { return pairs_; }
    std::span<const glm::dvec3> impulses() const { return p_; }  // (pairs) on a; the other way on b

    double tension(std::size_t pair) const { return -glm::dot(p_[pair], along_[pair]); }  // of a rod

  private:
    bool solveTaut(std::span<const glm::dvec3> at, std::span<const double> inverseMass,
                   std::span<const glm::dvec3> values, bool arePlaces, double settled);
    void findGiven(std::span<const glm::dvec3> at, std::span<const double> inverseMass);
    glm::dvec3 held(std::size_t pair, const glm::dvec3& difference) const;
    void respond(std::span<const glm::dvec3> at, std::span<const double> inverseMass);

    std::vector<core::RigidMotion> bodies_;
    std::vector<int> bodyOf_;  // (points) -1: none
    std::vector<Pair> pairs_;
    std::vector<glm::dvec3> p_, left_, way_, moved_;  // (pairs) impulse, residual, direction, A times it
    std::vector<glm::dvec3> best_;                    // (pairs) the impulses that left least
    std::vector<glm::dvec3> along_;                   // (pairs) unit, of a rod; 0
    std::vector<std::array<glm::dvec3, 2>> given_;    // (pairs) unit, to earlier pairs of the same bodies; 0
    std::vector<bool> isSlack_;                       // (pairs) of a leash: it does not count
    std::vector<double> ease_;                        // (pairs) [1/kg] approximate response to an impulse of 1
    std::vector<glm::dvec3> sum_, turn_;              // (bodies) of impulses, and of their moments
    std::vector<glm::dvec3> force_;                   // (points) of impulses
};

}  // namespace taut::world
