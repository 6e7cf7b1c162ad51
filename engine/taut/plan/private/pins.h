// The pins of an island: places on bodies kept in one place, with each other or with a place on a collider. They may
// come apart again; merged points never do. A pin of a seam closes by and by: until then its ends are drawn to a
// distance that shrinks to nothing, and may be nearer.
//
// A cluster is all points that pins hold together. It is projected at once. Its points come to their centre of mass and
// get its velocity, as if they were one point, or they follow the collider. Each pin of a spanning tree of the cluster
// bears the impulses of all points beyond it.
//
//     o----o----o----o      A pin that ends between points, as of a finer edge on a coarser one, is a row of J x = 0,
//     |  x | x  | x  |      with its weights. The impulses λ of all rows solve (J M⁻¹ Jᵀ) λ = -J x, M the masses of
//     o----o----o----o      clusters.
//
// All of it is linear, so it is exact and keeps momentum and angular momentum.
#pragma once

#include <cmath>

#include "taut/plan/constraint.h"
#include "taut/plan/private/envelope_matrix.h"
#include "taut/plan/private/tie_ends.h"
#include "taut/spec/source.h"

namespace taut::world {

class Pins final : public ConstraintOf<Pins> {
  public:
    // Ties two spots of the plan, or a spot and a place.
    void tie(const Spot& a, const Spot& b, const Source& source);
    void tie(const Spot& a, const Place& b, const Source& source);
    // Ties two spots, `length` [m] apart at `start` [s], that have come together `over` [s] > 0 later. In between they
    // are at most length (1 - s)² (1 + 2 s) apart, s = (t - start)/over: it begins and ends at rest.
    struct Closing {
        static constexpr double notBegun = -1;  // a length that begin() finds
        double length = 0, over = 0, start = 0;
        double end() const { return start + over; }
        double mostAt(double t) const;   // [m]
        double speedAt(double t) const;  // [m/s] below 0
    };
    void sew(const Spot& a, const Spot& b, const Closing& closing, const Source& source);
    // Moves the plan's positions to where its pins between bodies hold, as far as they are closed.
    static void settle(IslandPlan& plan);
    // The points that pins hold together with this one, itself included, ascending.
    std::vector<int> clusterOf(int point) const;

    std::span<const int> points() const override { return ends_.points; }
    std::span<const Place> places() const override { return ends_.places; }
    int size() const override { return static_cast<int>(pins_.size()); }
    bool projectPositions(const Moment& moment) override { return project(moment.x, moment); }
    bool projectVelocities(const Moment& moment) override { return project(moment.v, moment); }
    std::span<const Pair> pairs(double t) override;
    std::optional<std::vector<Pair>> joinedFrom(double t) const override;
    bool carries(int point) const override;
    void check() const override;
    bool isDue(double t) const override;
    void begin(double t, std::span<const dvec3> x) override;

  private:
    struct Pin {
        Spot a, b;  // numbers as in Moment
        Source source;
        Closing closing{};  // over = 0: it is closed from the start
        bool joinsPoints() const { return a.isPoint() && b.isPoint(); }
    };
    // A point or place of a cluster, in the order of a walk from its root.
    struct Node {
        int number;  // as in Moment
        int parent;  // of nodes_; -1: it is the root
        int pin;     // to the parent
    };
    struct Cluster {
        int first, last;  // of nodes_
    };

    // A closed pin between points: the weights of its points, and of their clusters.
    struct Row {
        int pin;
        std::vector<Spot::Share> points, clusters;
    };
    // Two rows that share a cluster, or a row and itself.
    struct Coupling {
        int i, j, cluster;
        double weight;
    };

    void tiesChanged() override { layOut(time_); }
    void visitOwn(StateBytes& bytes) override;
    void layOut(double t);
    bool project(std::span<dvec3> values, const Moment& moment);
    bool draw(std::span<dvec3> values, const Moment& moment);
    bool join(std::span<dvec3> values, const Moment& moment);
    bool joinBetween(std::span<dvec3> values, const Moment& moment);
    void layOutRows(std::span<const int> rows);
    void listPairs();
    void bear(const Cluster& cluster, const Moment& moment);

    TieEnds ends_;
    std::vector<Pin> pins_;
    std::vector<Node> nodes_;
    std::vector<Cluster> clusters_;
    std::vector<Row> rows_;
    std::vector<Pair> pairs_;
    std::vector<Coupling> couplings_;
    EnvelopeMatrix matrix_;  // (rows)
    std::vector<int> open_;  // pins that are not closed yet at time_ [s]
    double time_ = 0;
    double from_ = 0, until_ = HUGE_VAL;  // [s] when the pins that are open are these
    std::vector<dvec3> sum_;              // (nodes) scratch
    std::vector<int> nodeOf_;             // (as Moment) of nodes_; -1: none
    std::vector<double> diagonal_;        // (rows) scratch
    std::vector<dvec3> pull_;             // (rows) scratch
    std::vector<dvec3> way_;              // (clusters) scratch
    std::vector<double> ease_;            // (clusters) [1/kg] scratch
};

}  // namespace taut::world
