// Which points may meet which triangles, and which edges which, in an instant: lists that outlive the instant they were
// made in, for as long as what they are about has not come nearer than they reach. They may name too much, never too
// little: what comes out of an instant does not depend on when they were made.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "taut/contact/bvh.h"

namespace taut::contact {

// A point and a triangle, or two edges, of which at least one pair of points may come into contact.
struct CandidatePair {
    int a, b;          // point and triangle; or edges, the lower first
    double thickness;  // [m] that they keep
};

// Pairs that are further apart than what is coming, and that share of what they keep, cannot meet in an instant, and
// need not be watched.
inline constexpr double watchShare = 0.5;

class BroadPhase {
  public:
    explicit BroadPhase(const Elements& elements) : elements_(elements), bvh_(elements) {}

    // Forgets all lists: to be called when points have jumped, or something is gone.
    void drop();

    // Lists all that comes within reach on the way from x0 to x1 (points) [m].
    void find(std::span<const dvec3> x0, std::span<const dvec3> x1);
    // On the way from x0 to x1 nobody meets anybody.
    void go(std::span<const dvec3> x0, std::span<const dvec3> x1);
    // Nobody went further than that [m] beyond the ways that were found: whether the lists hold for them too, and no
    // pair that was not near can have met.
    bool holdWithin(double way) const { return 2 * way <= slack_; }
    // The end of the instant: of these points (ascending) x1 is not what it was when pairs were found.
    void arrive(std::span<const int> moved, std::span<const dvec3> x0, std::span<const dvec3> x1);

    Bvh& bvh() { return bvh_; }

    struct CandidateList {
        int a = 0, b = 0;  // leaves
        std::vector<CandidatePair> pairs;
        std::size_t pointPairs = 0;  // the first of them: of points and triangles
        // (pairs) [m] Until it has travelled that far, by what was last found between them, and come that much nearer,
        // by what was between them when they were listed, none of a pair is near.
        std::vector<double> nearTravelled, nearApproached;
        double travelled = 0;    // [m] at most, since they were listed, the coming way included: a sum of ways
        double approached = 0;   // [m] likewise, from where they were then
        double coming = 0;       // [m] of that the coming way
        bool isNew = false;      // its list has expired in this instant
        bool isPassing = false;  // both pass each other by in this instant
        bool isFlat = false;     // nothing of it meets in this instant

        double most = 0;            // [m] that pairs keep: the sum of the thicknesses
        double leastThickness = 0;  // [m] of the pairs
        // None of them is near until it has travelled that far, or come that much nearer [m].
        double asleepTravelled = 0, asleepApproached = 0;
        double valid = -1;              // [m] until it may have come that much nearer it names all that is near
        dvec3 apart{0.0};               // [m] of the centres when they were listed
        double strayA = 0, strayB = 0;  // [m] of the leaves until then
        double bentA = 0, bentB = 0;    // [m] of them then
        int timesA = -1, timesB = -1;   // that they were remembered until then
        double way = 0;                 // [m] sum of the ways since then, the coming one left out
        double apartAtLeast = 0;        // [m] of what it does not name, when it ceases to be valid
        std::vector<int> about;         // leaves
    };
    // In the order of the leaves; those of which a pair may be near in an instant.
    std::size_t awakeCount() const { return awake_.size(); }
    CandidateList& awake(std::size_t i) { return *awake_[i]; }

    std::size_t listed() const { return listed_; }  // lists made so far
    std::uint64_t bytes() const;

  private:
    struct Known {
        LeafPair pair;
        CandidateList* list;
        // Nothing about it changes until its leaves have gone that far in sum [m] since they had gone so far.
        double quiet = -1, since = 0;
        double counted = 0;                           // [m] of their ways that the list's way has in it
        double apartAtLeast = 0, leastThickness = 0;  // [m] of the list
    };

    void search(double room);
    void addWays();
    double goneOf(LeafPair pair) const;
    void look(Known& known, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    bool staysWhereSearched(std::span<const dvec3> x0, std::span<const dvec3> x1, double bent);
    bool passesBy(const CandidateList& list, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    static void clear(CandidateList& list);
    CandidateList* newList(LeafPair pair);
    double comingOf(const CandidateList& list) const;
    void approach(CandidateList& list) const;
    void restart(CandidateList& list, double valid) const;
    void makeList(CandidateList& list, std::span<const dvec3> x0) const;

    const Elements& elements_;
    Bvh bvh_;
    std::deque<CandidateList> lists_;     // in no order
    std::vector<CandidateList*> unused_;  // of them
    std::vector<Known> known_, merged_;   // ascending
    std::vector<Known*> looked_;          // those that were not quiet
    std::vector<CandidateList*> awake_;
    std::vector<double> stray_;          // [m] (leaves) sum over all instants
    std::vector<double> gone_;           // [m] (leaves) likewise, how far any of its points has gone at most
    std::vector<char> isLooked_;         // (known) scratch
    std::vector<Box> roomy_;             // (leaves) while all stay within, all that are near are known
    std::vector<double> goneThen_;       // [m] (leaves) until then
    double lasting_ = 0;                 // [m] that they may go since then at least, and stay
    std::vector<double> slacks_;         // (tasks) scratch
    std::vector<int> about_, leafList_;  // leaves, scratch
    std::vector<LeafPair> found_;
    double slack_ = 0;
    std::size_t listed_ = 0;
};

}  // namespace taut::contact
