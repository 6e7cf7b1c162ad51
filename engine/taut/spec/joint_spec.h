// What ties points of bodies to points of others, or to a collider, as a scene names it. The kinds are in joints/.
//
// To add a kind: derive from SpecOf<Own, JointSpec>, give it a `kindName`, title(), tie() and carry(), and add
// jointKind<Own>(help, rows) to a table of kinds (common_rows.h, Kinds::joints); tests/unit/world_own_joint_test.cpp
// does.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "taut/spec/source.h"

namespace taut::world {

struct Grip;
struct IslandPlan;

// Targets are written KIND.NAME@SELECTOR, e.g. "cloth.flag@left"; NAME may have the wildcard *.
struct JointSpec {
    std::string a, b;
    Source source;

    JointSpec() = default;
    JointSpec(std::string first, std::string second, Source where = {})
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
    // Whether two points become one, and points tied to a collider move with it. Then tie() and carry() are not called.
    virtual bool isWeld() const { return false; }
    // Adds to the plan what ties two of its points, `distance` [m] apart: springs, constraints.
    virtual void tie(IslandPlan& plan, int a, int b, double distance) const = 0;
    // The same between points and a collider. The rigid grip has those points and the present pose of the collider.
    virtual void carry(IslandPlan& plan, Grip grip) const = 0;
};

}  // namespace taut::world
