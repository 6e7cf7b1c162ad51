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

// What is known of one body without building it.
struct BodyEntry {
    std::string kind, name;      // "cloth", "flag"
    int copies = 1;              // more than one: called flag.0, flag.1, …
    bool isFaulty = false;       // its numbers are not to be trusted
    world::BodyOutline outline;  // of one copy
    world::SolverOverride solver;

    std::string title() const { return kind + "." + name; }
};

class BodyIndex {
  public:
    // `faulty` names bodies with errors, "cloth.flag".
    BodyIndex(const world::SceneSpec& scene, const world::Kinds& kinds, const std::set<std::string>& faulty);

    // KIND.NAME@SELECTOR; NAME may hold the wildcard *, and ends in .0, .1, … for one copy of an array.
    std::optional<TargetFault> pointsFault(const std::string& target) const;

    // The same, where a missing @SELECTOR means all points.
    std::optional<TargetFault> targetFault(const std::string& target) const;

    // KIND.NAME, with the same wildcard.
    std::optional<TargetFault> bodyFault(const std::string& target) const;

    // KIND.NAME of bodies with a surface.
    std::optional<TargetFault> surfaceFault(const std::string& target) const;

    // Of a target that is measured against another: whether both are one and the same body.
    std::optional<TargetFault> betweenFault(const std::string& first, const std::string& second) const;

    // A selector alone, of the body with this title.
    std::optional<TargetFault> selectorFault(const std::string& title, const std::string& selector) const;

    // The bodies that KIND.NAME or KIND.NAME@SELECTOR names, sorted; none if it is faulty.
    std::vector<const BodyEntry*> matches(const std::string& target) const;

    // The same by name, each copy of an array for itself: "cloth.flag", "cloth.tile.0"; of faulty bodies too.
    std::vector<std::string> names(const std::string& target) const;

  private:
    std::optional<TargetFault> bodiesFault(const std::string& target) const;

    std::vector<std::string> kinds_;
    std::vector<std::string> surfaceKinds_{"cloth", "block"};  // and those that the scene has
    std::vector<BodyEntry> bodies_;
};

}  // namespace taut::scene
