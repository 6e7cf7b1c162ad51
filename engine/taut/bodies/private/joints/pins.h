// The pins of an island: points that stay in one place, with each other or with a place on a collider, and may come
// apart again. Points that are merged never do.
//
// What pins hold together is a cluster. It is projected at once: its points come to their centre of mass and have its
// velocity, as if they were one point; or to the collider. The constraint is linear, so that this is exact, and keeps
// momentum and angular momentum. Along a spanning tree of the cluster each pin bears what all beyond it are moved by.
#pragma once

#include "taut/bodies/joints/constraint.h"
#include "taut/spec/source.h"

namespace taut::world {

class Pins final : public ConstraintOf<Pins> {
  public:
    // Between points of the plan; between a point and a place.
    void tie(int a, int b, const Source& source);
    void tie(int a, const Place& b, const Source& source);
    // The points that pins hold together with this one, which is among them, ascending.
    std::vector<int> clusterOf(int point) const;

    std::span<const int> points() const override { return points_; }
    std::span<const Place> places() const override { return places_; }
    int size() const override { return static_cast<int>(pins_.size()); }
    bool projectPositions(const Moment& moment) override { return project(moment.x, moment); }
    bool projectVelocities(const Moment& moment) override { return project(moment.v, moment); }
    bool carries(int point) const override;
    void check() const override;

  private:
    struct Pin {
        int a, b;  // of points_; below 0, -1 - place
        Source source;
    };
    // A point or place in a cluster, in the order of a walk from its root.
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
    void tiesChanged() override { layOut(); }
    void layOut();
    bool project(std::span<dvec3> values, const Moment& moment);

    std::vector<int> points_;
    std::vector<Place> places_;
    std::vector<Pin> pins_;
    std::vector<Node> nodes_;
    std::vector<Cluster> clusters_;
    std::vector<dvec3> sum_;  // (nodes) scratch
};

}  // namespace taut::world
