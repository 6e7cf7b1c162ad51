// What ties points of bodies to points of others, or to a collider, as a scene names it. The kinds are in joints/.
//
// To add a kind: derive from SpecOf<Own, JointSpec>, give it a `kindName`, title(), tie() and carry(), and add
// jointKind<Own>(help, rows) to a table of kinds (common_rows.h, Kinds::joints); tests/unit/world_own_joint_test.cpp
// does.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/spec/finish_spec.h"
#include "taut/spec/source.h"

namespace taut::world {

struct Grip;
struct IslandPlan;

// One side of a joint: one target, or several.
class JointSide {
  public:
    JointSide() = default;
    JointSide(std::string target) : targets{std::move(target)} {}
    JointSide(const char* target) : targets{target} {}
    JointSide(std::vector<std::string> all) : targets(std::move(all)) {}
    // As messages have it: "cloth.flag@left, cloth.flag@top".
    std::string text() const {
        std::string all;
        for (const std::string& target : targets) all += (all.empty() ? "" : ", ") + target;
        return all;
    }

    std::vector<std::string> targets;
};

// How each tie of a joint is drawn: a cord, or with turns a coil, from end to end; a ball where the ends are one.
struct JointLook {
    std::optional<FinishSpec> finish;  // none: not at all
    double radius = 0.01;              // [m] of the cord or wire
    int turns = 0;
    double coil = 0.04;  // [m] radius of the turns
};

// Targets are written KIND.NAME@SELECTOR, e.g. "cloth.flag@left"; NAME may have the wildcard *.
struct JointSpec {
    JointSide a, b;
    std::string name;                  // several may have one; empty: none
    std::optional<double> breakForce;  // [N] at which a tie of it lets go
    JointLook look;
    Source source;

    JointSpec() = default;
    JointSpec(JointSide first, JointSide second, Source where = {})
        : a(std::move(first)), b(std::move(second)), source(std::move(where)) {}
    JointSpec(const JointSpec&) = default;
    JointSpec& operator=(const JointSpec&) = default;
    virtual ~JointSpec() = default;
    virtual std::string_view kind() const = 0;   // "spring"
    virtual std::string_view title() const = 0;  // "a spring joint", as messages call it
    virtual std::unique_ptr<JointSpec> copy() const = 0;

    // Each point of a is tied to the nearest of b that is no further [m]; by a weld each of b once.
    virtual double reach() const { return HUGE_VAL; }
    // Whether two points of one body may be tied.
    virtual bool tiesWithin() const { return false; }
    // Whether points come to one place. If they need never come apart they become one, or go with the collider that
    // they are tied to, and tie() and carry() are not called.
    virtual bool isWeld() const { return false; }
    // Adds to the plan what ties two of its points, `distance` [m] apart: springs, constraints.
    virtual void tie(IslandPlan& plan, int a, int b, double distance) const = 0;
    // The same between a point and a collider. The rigid grip has that point and the present pose of the collider.
    virtual void carry(IslandPlan& plan, Grip grip) const = 0;

    // What is the same for every kind.
    bool mayLetGo() const { return !name.empty() || breakForce; }
    bool isDrawn() const { return look.finish.has_value(); }
    // Whether each of its ties is known by itself.
    bool hasOwnTies() const { return mayLetGo() || isDrawn(); }
};

}  // namespace taut::world
