// Which points may meet which triangles, and which edges which, in an instant: lists that outlive the instant they were
// made in, for as long as what they are about has not come nearer than they reach. They may name too much, never too
// little: what comes out of an instant does not depend on when they were made.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "taut/contact/patches.h"

namespace taut::contact {

// A point and a triangle, or two edges, of which at least one pair of points may come into contact.
struct NearPair {
    int a, b;         // point and triangle; or edges, the lower first
    double distance;  // [m] that they keep
};

// Pairs that are further apart than what is coming, and that share of what they keep, cannot meet in an instant, and
// need not be watched.
inline constexpr double watchShare = 0.5;

class NearPairs {
  public:
    explicit NearPairs(const Elements& elements) : elements_(elements), patches_(elements) {}

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

    Patches& patches() { return patches_; }

    struct Record {
        int a = 0, b = 0;  // patches
        std::vector<NearPair> pairs;
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

        double most = 0;       // [m] that pairs keep: the sum of the thicknesses
        double leastKeep = 0;  // [m] of the pairs
        // None of them is near until it has travelled that far, or come that much nearer [m].
        double asleepTravelled = 0, asleepApproached = 0;
        double valid = -1;              // [m] until it may have come that much nearer it names all that is near
        dvec3 apart{0.0};               // [m] of the centres when they were listed
        double strayA = 0, strayB = 0;  // [m] of the patches until then
        double bentA = 0, bentB = 0;    // [m] of them then
        int timesA = -1, timesB = -1;   // that they were remembered until then
        double way = 0;                 // [m] sum of the ways since then, the coming one left out
        double apartAtLeast = 0;        // [m] of what it does not name, when it ceases to be valid
        std::vector<int> about;         // patches
    };
    // In the order of the patches; those of which a pair may be near in an instant.
    std::size_t awakeCount() const { return awake_.size(); }
    Record& awake(std::size_t i) { return *awake_[i]; }

    std::size_t listed() const { return listed_; }  // lists made so far
    std::uint64_t bytes() const;

  private:
    struct Known {
        PatchPair pair;
        Record* record;
        // Nothing about it changes until its patches have gone that far in sum [m] since they had gone so far.
        double quiet = -1, since = 0;
        double counted = 0;                      // [m] of their ways that the record's way has in it
        double apartAtLeast = 0, leastKeep = 0;  // [m] of the record
    };

    void search(double room);
    void addWays();
    double goneOf(PatchPair pair) const;
    void look(Known& known, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    bool staysWhereSearched(std::span<const dvec3> x0, std::span<const dvec3> x1, double bent);
    bool passesBy(const Record& record, std::span<const dvec3> x0, std::span<const dvec3> x1) const;
    static void clear(Record& record);
    Record* newRecord(PatchPair pair);
    double comingOf(const Record& record) const;
    void approach(Record& record) const;
    void restart(Record& record, double valid) const;
    void list(Record& record, std::span<const dvec3> x0) const;

    const Elements& elements_;
    Patches patches_;
    std::deque<Record> records_;         // in no order
    std::vector<Record*> unused_;        // of them
    std::vector<Known> known_, merged_;  // ascending
    std::vector<Known*> looked_;         // those that were not quiet
    std::vector<Record*> awake_;
    std::vector<double> stray_;           // [m] (patches) sum over all instants
    std::vector<double> gone_;            // [m] (patches) likewise, how far any of its points has gone at most
    std::vector<char> isLooked_;          // (known) scratch
    std::vector<Box> roomy_;              // (patches) while all stay within, all that are near are known
    std::vector<double> goneThen_;        // [m] (patches) until then
    double lasting_ = 0;                  // [m] that they may go since then at least, and stay
    std::vector<double> slacks_;          // (tasks) scratch
    std::vector<int> about_, patchList_;  // patches, scratch
    std::vector<PatchPair> found_;
    double slack_ = 0;
    std::size_t listed_ = 0;
};

}  // namespace taut::contact
