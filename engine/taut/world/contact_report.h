// What bodies that touch are seen to do: what presses on what, and since when they cross. Unlike what keeps them apart
// it outlives the tick, and goes with the state.
#pragma once

#include <string>
#include <vector>

#include "taut/bodies/state_bytes.h"
#include "taut/world/contact_stage.h"

namespace taut::world {

// Two parts of bodies that press on each other.
struct BodyContact {
    dvec3 place{0.0}, normal{0.0};  // [m] in the middle between both; unit, towards the first
    double impulse = 0;             // [N s] of the last instant
    const Body *first = nullptr, *second = nullptr;
};

// An edge through a triangle.
struct BodyCrossing {
    dvec3 place{0.0};  // [m] where the edge goes through
    double depth = 0;  // [m] by which the nearer end of the edge is through
    const Body *ofEdge = nullptr, *ofTriangle = nullptr;
    int edge = 0;
};

// Those that there are now.
std::vector<BodyCrossing> crossingsOf(ContactStage& stage);

class ContactReport {
  public:
    // After each tick, with the moment at which it began [s].
    void look(const ContactStage& stage, double start);
    void forget(const Body& body);

    const std::vector<BodyContact>& contacts() const { return contacts_; }  // at the end of the last tick
    bool hasMet() const { return hasMet_; }                                 // since it was made
    // Which bodies cross, or have.
    std::vector<std::string> warnings() const;

    bool isWorthSaving() const { return !said_.empty() || !contacts_.empty(); }
    // Expects the same bodies, in the same order, for writing and reading.
    void visit(StateBytes& bytes, std::span<const Body* const> bodies);

  private:
    struct Said {
        std::string first, second;          // bodies; of one that has crossed itself the same
        std::string text;                   // as long as they do
        double since = 0, until = 0;        // [s] the last time
        std::int64_t edges = 0, times = 1;  // the last time, as it began; how often in all
        bool isOn = true;
    };
    std::vector<BodyContact> contacts_;
    std::vector<Said> said_;
    bool hasMet_ = false;
};

}  // namespace taut::world
