// The language of checks: a claim such as "max_strain(cloth.*) < 0.1" as a text, and its evaluation in a world.
// Independent of files; the caller checks that a scene has the named bodies.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "taut/world/world_info.h"

namespace taut::world {
class BodySurfaces;
class World;
}  // namespace taut::world

namespace taut::check {

struct Function;

// Why a text is no claim.
struct ClaimError : std::runtime_error {
    ClaimError(std::size_t where, const std::string& message, std::string help = {})
        : std::runtime_error(message), at(where), remedy(std::move(help)) {}
    std::size_t at;      // byte of the text, from 0
    std::string remedy;  // a short phrase; may be empty
};

// Bodies or points that a claim speaks of, or joints.
struct Mention {
    std::size_t at = 0;      // byte of the text
    std::string target;      // "cloth.*", "cloth.flag@left"
    bool hasPoints = false;  // it may have a @SELECTOR
    bool isNeeded = false;   // there must be such when it is evaluated
    bool isJoint = false;    // the name of joints
    std::string against;     // of the second of two bodies that something is measured between: the first
};

// A function that a claim calls.
struct Call {
    std::size_t at = 0;  // byte of the text
    const Function* function = nullptr;
    std::vector<Mention> targets;
};

// The result of a claim at one moment: of the comparison that fails by most, or is nearest to failing.
struct Outcome {
    bool holds = false;
    double value = 0;
    std::string relation;  // of value to bound: "<"
    double bound = 0;
    std::string unit;     // of the two sides; empty without a unit
    double margin = 0;    // how far the value is inside the bound; negative if it fails, not a number if either is none
    std::string subject;  // "max_strain(cloth.*)": the part of the claim that has the value
};

struct Claim;
class Now;

// Targets in a world, and the surfaces of two of them, each cached while no body comes or goes.
struct Selections {
    std::map<std::string, world::Selection> of;
    std::map<std::pair<std::string, std::string>, std::shared_ptr<world::BodySurfaces>> surfaces;
};

class Check {
  public:
    // Throws ClaimError, also for a claim that speaks of nothing that changes.
    static Check parse(std::string_view text);

    // In the order of the text.
    const std::vector<Mention>& mentions() const;
    std::vector<Call> calls() const;

    // At a published tick. Throws core::Error(badContent) for a target that finds no points.
    Outcome evaluate(const world::World& world) const;
    Outcome evaluate(const Now& now) const;  // shares measurements with other claims

    // Where the value of that moment is found: "cloth.flag@#12 at [0.1, 2.0, 0.3]"; empty: nowhere in particular.
    std::string where(const Now& now) const;

  private:
    std::shared_ptr<const Claim> claim_;
    std::vector<Mention> mentions_;
};

// Every function, a line or two each, for the manual.
std::string functionsManual();

}  // namespace taut::check
