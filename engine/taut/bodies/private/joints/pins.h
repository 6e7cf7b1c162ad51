// The pins of an island: points kept in one place, with each other or with a place on a collider. They may come apart
// again; merged points never do. A pin of a seam closes by and by: until then its ends are drawn to a distance that
// shrinks to nothing, and may be nearer.
//
// A cluster is all that pins hold together. It is projected at once. Its points come to their centre of mass and get
// its velocity, as if they were one point, or they follow the collider. The constraint is linear, so this is exact and
// keeps momentum and angular momentum. Each pin of a spanning tree of the cluster bears the impulses of all points
// beyond it.
#pragma once

#include <cmath>

#include "taut/bodies/joints/constraint.h"
#include "taut/spec/source.h"

namespace taut::world {

class Pins final : public ConstraintOf<Pins> {
  public:
    // Ties two points of the plan, or a point and a place.
    void tie(int a, int b, const Source& source);
    void tie(int a, const Place& b, const Source& source);
    // Ties two points, `length` [m] apart at `start` [s], that have come together `over` [s] > 0 later. In between they
    // are at most length (1 - s)² (1 + 2 s) apart, s = (t - start)/over: it begins and ends at rest.
    struct Closing {
        static constexpr double notBegun = -1;  // a length that begin() finds
        double length = 0, over = 0, start = 0;
        double end() const { return start + over; }
        double mostAt(double t) const;   // [m]
        double speedAt(double t) const;  // [m/s] below 0
    };
    void sew(int a, int b, const Closing& closing, const Source& source);
    // The points that pins hold together with this one, itself included, ascending.
    std::vector<int> clusterOf(int point) const;

    std::span<const int> points() const override { return points_; }
    std::span<const Place> places() const override { return places_; }
    int size() const override { return static_cast<int>(pins_.size()); }
    bool projectPositions(const Moment& moment) override { return project(moment.x, moment); }
    bool projectVelocities(const Moment& moment) override { return project(moment.v, moment); }
    std::vector<Pair> pairs(double t) override;
    std::optional<std::vector<Pair>> joinedFrom(double t) const override;
    bool carries(int point) const override;
    void check() const override;
    bool isDue(double t) const override;
    void begin(double t, std::span<const dvec3> x) override;

  private:
    struct Pin {
        int a, b;  // of points_; below 0: -1 - place
        Source source;
        Closing closing{};  // over = 0: it is closed from the start
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

    int numberOf(int point);
    int end(int number) const { return number >= 0 ? number : static_cast<int>(points_.size()) - 1 - number; }
    bool isPlace(int number) const { return number >= static_cast<int>(points_.size()); }
    void tiesChanged() override { layOut(time_); }
    void visitOwn(StateBytes& bytes) override;
    void layOut(double t);
    bool project(std::span<dvec3> values, const Moment& moment);
    bool draw(std::span<dvec3> values, const Moment& moment);
    bool join(std::span<dvec3> values, const Moment& moment);

    std::vector<int> points_;
    std::vector<Place> places_;
    std::vector<Pin> pins_;
    std::vector<Node> nodes_;
    std::vector<Cluster> clusters_;
    std::vector<int> open_;  // pins that are not closed yet at time_ [s]
    double time_ = 0;
    double from_ = 0, until_ = HUGE_VAL;  // [s] when the pins that are open are these
    std::vector<dvec3> sum_;              // (nodes) scratch
};

}  // namespace taut::world
