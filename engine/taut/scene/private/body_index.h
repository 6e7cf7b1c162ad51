// The bodies of a scene by name, and whether a target such as "cloth.flag@left" finds points in them.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "taut/spec/kinds.h"
#include "taut/spec/spec.h"

namespace taut::scene {

// Why a target or a selector does not work.
struct TargetFault {
    std::string message, remedy;
};

// Data of a body before it is built.
struct BodyEntry {
    std::string kind, name;      // "cloth", "flag"
    int copies = 1;              // if more than one, they are flag.0, flag.1, …
    bool isFaulty = false;       // its numbers cannot be trusted
    world::BodyOutline outline;  // of one copy
    world::SolverOverride solver;

    std::string title() const { return kind + "." + name; }
};

class BodyIndex {
  public:
    // `faulty` names bodies with errors, "cloth.flag".
    BodyIndex(const world::SceneSpec& scene, const world::Kinds& kinds, const std::set<std::string>& faulty);

    // For KIND.NAME@SELECTOR. NAME may contain the wildcard *, and ends in .0, .1, … for one copy of an array.
    std::optional<TargetFault> pointsFault(const std::string& target) const;

    // The same, but a rigid body may be named as a whole, and has places by name.
    std::optional<TargetFault> tieableFault(const std::string& target) const;

    // Like pointsFault(), but a missing @SELECTOR means all points.
    std::optional<TargetFault> targetFault(const std::string& target) const;

    // For KIND.NAME with the same wildcard.
    std::optional<TargetFault> bodyFault(const std::string& target) const;

    // For KIND.NAME of bodies with a surface.
    std::optional<TargetFault> surfaceFault(const std::string& target) const;

    // For two targets to be measured against each other: whether both are the same body.
    std::optional<TargetFault> betweenFault(const std::string& first, const std::string& second) const;

    // For a selector alone, of the body with this title.
    std::optional<TargetFault> selectorFault(const std::string& title, const std::string& selector) const;

    // The bodies of KIND.NAME or KIND.NAME@SELECTOR, sorted; none if the target is faulty.
    std::vector<const BodyEntry*> matches(const std::string& target) const;

    // The same by name, with each copy of an array: "cloth.flag", "cloth.tile.0". Includes faulty bodies.
    std::vector<std::string> names(const std::string& target) const;

  private:
    std::optional<TargetFault> bodiesFault(const std::string& target) const;

    std::vector<std::string> kinds_;
    std::vector<std::string> surfaceKinds_{"cloth", "block"};  // and further kinds of the scene
    std::vector<BodyEntry> bodies_;
};

}  // namespace taut::scene
