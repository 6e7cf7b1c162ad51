// Reports of contact: which bodies press on each other now, and which have crossed since when. Unlike the
// contact stage it survives changes of bodies, and is saved with the state.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "taut/plan/state_bytes.h"
#include "taut/world/private/contact_stage.h"

namespace taut::world {

// Two bodies that press on each other, or a body and a figure, at one place.
struct BodyContact {
    dvec3 place{0.0}, normal{0.0};                   // [m] midpoint; unit, towards the first
    double impulse = 0;                              // [N s] of the last step
    const Body *first = nullptr, *second = nullptr;  // null: the figure
    bool isOf(const Body& body) const { return first == &body || second == &body; }
};

// An edge that pierces a triangle.
struct BodyCrossing {
    dvec3 place{0.0};  // [m] where the edge goes through
    double depth = 0;  // [m] of the closer end of the edge behind the triangle's plane
    const Body *ofEdge = nullptr, *ofTriangle = nullptr;
    int edge = 0;
};

// The present crossings of bodies.
std::vector<BodyCrossing> crossingsOf(ContactStage& stage);

class ContactReport {
  public:
    // To be called after each tick, with the time of its start [s].
    void look(const ContactStage& stage, double start);
    void forget(const Body& body);

    const std::vector<BodyContact>& contacts() const { return contacts_; }             // at the end of the last tick
    const std::map<const Body*, std::int64_t>& squeezed() const { return squeezed_; }  // number of points of a body
    bool hadImpulse() const { return hadImpulse_; }                                    // at any time since it was made
    // One warning for each pair of bodies, or of a body and a figure, that cross or have crossed.
    std::vector<std::string> warnings() const;

    bool isWorthSaving() const { return !said_.empty() || !contacts_.empty() || !squeezed_.empty(); }
    // Expects the same bodies in the same order for writing and reading.
    void visit(StateBytes& bytes, std::span<const Body* const> bodies);

  private:
    // A warning.
    struct Said {
        std::string first, second;    // equal if a body crosses itself
        std::string text;             // while they cross
        double since = 0, until = 0;  // [s] of the last time
        std::int64_t edges = 0;       // that crossed at the start of the last time
        std::int64_t times = 1;       // number of times
        bool isOn = true;             // they cross at present
    };
    std::vector<BodyContact> contacts_;
    std::map<const Body*, std::int64_t> squeezed_;
    std::vector<Said> said_;
    bool hadImpulse_ = false;
};

}  // namespace taut::world
