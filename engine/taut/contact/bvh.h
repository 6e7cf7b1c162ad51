// Surfaces in leaves of some fifteen triangles, or edges where there are none, and a tree over them: which leaves
// come near each other in an instant. Bvh hang on what the surfaces are at rest, never on where they are.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "taut/contact/elements.h"

namespace taut::contact {

struct Box {
    dvec3 low{1e300}, high{-1e300};
    void add(const dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool overlaps(const Box& other, double within) const {
        return low.x <= other.high.x + within && other.low.x <= high.x + within && low.y <= other.high.y + within &&
               other.low.y <= high.y + within && low.z <= other.high.z + within && other.low.z <= high.z + within;
    }
};

inline constexpr std::size_t leafSize = 18;  // triangles, or edges, at most

using Axes = std::array<dvec3, 3>;

struct BvhLeaf {
    int surface = 0;
    // All that there is belongs to one leaf; an edge or a point to the first that has it.
    std::vector<int> triangles, edges, points;
    std::vector<int> corners;  // all points of those
};

// How a leaf moves in an instant.
struct LeafMotion {
    Box before, box;     // of its points; of those before and after
    dvec3 centre{0.0};   // [m] mean of its points, before
    dvec3 way{0.0};      // [m] of that mean
    double deviation = 0.0;  // [m] no point goes further than that from the way of the mean
    // Seen from the mean no point is further than that from where it was when the leaf was last remembered, before and
    // after [m]; and how often that has been.
    double deformation = 0.0;
    int reference = 0;
};

// How far a leaf of a surface that is flat at rest is from being moved as one, before and after: for all directions t
// of all of its triangles t·Rᵀ F t is at least `least` and F t at most `most`, F the gradient of the deformation and R
// the mean of those.
struct Flatness {
    dvec3 right{0.0}, up{0.0}, normal{0.0};  // columns of R, and across
    double least = -1.0;
    double most = 0.0;
};

// Two leaves, the lower above the higher: pairs in order are in the order of the first, then of the second.
using LeafPair = std::uint64_t;
inline LeafPair leafPair(int a, int b) {
    const auto low = static_cast<LeafPair>(a < b ? a : b), high = static_cast<LeafPair>(a < b ? b : a);
    return low << 32U | high;
}
inline int lowOf(LeafPair pair) {
    return static_cast<int>(pair >> 32U);
}
inline int highOf(LeafPair pair) {
    return static_cast<int>(pair & 0xffffffffU);
}

class Bvh {
  public:
    explicit Bvh(const Elements& elements);

    int count() const { return static_cast<int>(leaves_.size()); }
    const BvhLeaf& operator[](int i) const { return leaves_[static_cast<std::size_t>(i)]; }

    // The balls there are have become others.
    void takeBalls();

    // An instant from x0 to x1 (points) [m] begins: of leaves is known only how far any of their points goes.
    void start(std::span<const dvec3> x0, std::span<const dvec3> x1);
    double travel(int leaf) const { return travel_[static_cast<std::size_t>(leaf)]; }  // [m]
    // The motions of those of them that were not followed since. Bvh that have bent further than `most` [m] are
    // remembered anew.
    void follow(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1, double most);
    bool isFollowed(int leaf) const { return isFollowed_[static_cast<std::size_t>(leaf)] != 0; }
    void followAll(std::span<const dvec3> x0, std::span<const dvec3> x1, double most = 0.0);
    // Of these points x1 has changed since: how far their leaves go, and points stray from them.
    void correct(std::span<const int> points, std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Of a leaf that was followed.
    const LeafMotion& motion(int leaf) const { return motions_[static_cast<std::size_t>(leaf)]; }

    // Pairs a <= b of leaves whose boxes (leaves) come within the sum of the thicknesses, and that much more [m], and
    // which may meet; ascending.
    void findNear(std::span<const Box> boxes, double more, std::vector<LeafPair>& pairs);

    // How flat all of what lies about two leaves of one surface is in this instant: no two parts of it come nearer
    // than that share of their distance at rest. For where the surface is flat and convex at rest and all of it about
    // them is moved nearly as one, |f(p) - f(q)| >= ∫ t·RᵀF t ds >= least |p - q| along the straight way at rest.
    // Negative where that cannot be told. Expects that what lies about them was measured.
    double flatness(std::span<const int> leavesBetween) const;
    // Of leaves followed from x0 to x1; those that were measured since then already stand.
    void measureFlatness(std::span<const int> leaves, std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Parts that stay further apart than this share of their distance at rest are not in contact.
    double requiredFlatness(int surface) const { return requiredFlatness_[static_cast<std::size_t>(surface)]; }
    bool isPlane(int surface) const { return planes_[static_cast<std::size_t>(surface)].has_value(); }
    // The least distance at rest of parts of a surface that do not hang together; of those that are flat. [m]
    double leastAltitude(int surface) const { return altitudes_[static_cast<std::size_t>(surface)]; }
    // What lies about them: all leaves that the box at rest of both overlaps. None where that cannot be told, or of
    // more than a few.
    std::vector<int> leavesBetween(int a, int b) const;

  private:
    struct Node {
        int left = -1, right = -1;  // nodes
        int leaf = -1;              // of a leaf
        int surface = -1;           // -1: several
        double thickness = 0;       // [m] largest
    };
    struct Plane {  // of a surface that is flat and convex at rest
        dvec3 right, up;
    };
    using Rest2 = glm::dvec2;
    struct RestBox {
        Rest2 low{1e300}, high{-1e300};
    };

    int addTree(std::vector<int> items, const std::vector<dvec3>& centres, int surface, const Axes& axes,
                bool areTriangles);
    int addLeaf(const std::vector<int>& items, int surface, bool areTriangles);
    int joinRoots(std::span<const int> roots);
    void shareOut();
    void takeReference(std::size_t leaf, std::span<const dvec3> x);
    void findTravel(std::size_t leaf);
    void findWay(std::size_t leaf, std::span<const dvec3> x0, std::span<const dvec3> x1);
    void findPlane(int surface, const dvec3& along);
    void prepareFlatness();
    void measureOne(std::size_t leaf, std::span<const dvec3> x0, std::span<const dvec3> x1);
    void findPairsWithin(int node, double more, std::vector<LeafPair>& pairs) const;
    void findPairsBetween(int a, int b, double more, std::vector<LeafPair>& pairs) const;

    const Elements& elements_;
    std::vector<BvhLeaf> leaves_;
    std::vector<int> all_;  // their numbers
    std::vector<int> leafOfPoint_, leafOfEdge_;
    std::vector<int> leavesAt_;         // of which points are corners, point by point
    std::vector<std::size_t> firstAt_;  // (points + 1) of those
    std::vector<char> isCorrected_;     // (leaves) scratch
    std::vector<int> toFollow_;         // leaves, scratch
    std::vector<Node> nodes_;           // children before parents
    int root_ = -1;
    std::vector<double> ways_;                  // [m²] (points) of the instant, squared
    std::vector<double> travel_;                 // [m] (leaves)
    std::vector<char> isFollowed_;              // (leaves)
    std::vector<LeafMotion> motions_;           // (leaves)
    std::vector<dvec3> referenceShape_;             // [m] of the corners of all leaves, from the mean
    std::vector<std::size_t> firstReference_;  // (leaves)
    std::vector<int> references_;                    // (leaves) remembered
    std::vector<Box> boxes_;                    // (nodes) scratch
    std::vector<std::optional<Plane>> planes_;  // (surfaces)
    struct Inverse {
        double a, b, c, d;  // of the two edges at corner 0, in the plane
    };
    std::vector<double> altitudes_;   // (surfaces) [m] smallest of a triangle
    std::vector<double> requiredFlatness_;      // (surfaces) see enough()
    std::vector<Inverse> inverses_;   // (triangles) of those in planes
    std::vector<RestBox> restBoxes_;  // (leaves) likewise
    struct Gradient {
        dvec3 right, up;  // where those of the plane are led
    };
    std::vector<Flatness> flatness_;          // (leaves)
    std::vector<Gradient> gradients_;         // of the triangles of leaves, before and after
    std::vector<std::size_t> firstGradient_;  // (leaves + 1)
    std::vector<char> isMeasured_;            // (leaves) since they were followed last
    std::vector<int> toMeasure_;              // leaves, scratch
    std::vector<char> isStillFollowed_;               // (leaves) of still surfaces: where they are
};

}  // namespace taut::contact
