// A tie between points of bodies, or of points to a collider, as a scene names it. The kinds are in joints/.
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
struct Mounting;
class Spot;

// One side of a joint: one target, or several.
class JointSide {
  public:
    JointSide() = default;
    JointSide(std::string target) : targets{std::move(target)} {}
    JointSide(const char* target) : targets{target} {}
    JointSide(std::vector<std::string> all) : targets(std::move(all)) {}
    // The targets as messages show them: "cloth.flag@left, cloth.flag@top".
    std::string text() const {
        std::string all;
        for (const std::string& target : targets) all += (all.empty() ? "" : ", ") + target;
        return all;
    }

    std::vector<std::string> targets;
};

// How each tie of a joint is drawn: from end to end a cord, or a coil if it has turns; a ball where both ends are one.
struct JointLook {
    std::optional<FinishSpec> finish;  // none: not drawn
    double radius = 0.01;              // [m] of the cord or wire
    int turns = 0;
    double coil = 0.04;  // [m] radius of the turns
};

constexpr double weldReach = 0.02;  // [m] of a weld by default, see reach()

// Targets are written KIND.NAME@SELECTOR, e.g. "cloth.flag@left"; NAME may have the wildcard *.
struct JointSpec {
    JointSide a, b;
    std::string name;                  // several joints may share a name; empty: none
    std::optional<double> breakForce;  // [N] at which a tie breaks
    bool touch = false;                // whether the rigid bodies that it joins collide with each other
    // [m] Where the scene starts; none: as the kind says.
    std::optional<dvec3> place;
    // The axes of `place`: of the first side that is a whole body or a collider, or of the scene.
    enum class PlaceIn { side, world } placeIn = PlaceIn::side;
    JointLook look;
    Source source;

    JointSpec();
    JointSpec(JointSide first, JointSide second, Source where = {})
        : a(std::move(first)), b(std::move(second)), source(std::move(where)) {}
    JointSpec(const JointSpec&);
    JointSpec& operator=(const JointSpec&);
    virtual ~JointSpec();
    virtual std::string_view kind() const = 0;   // "spring"
    virtual std::string_view title() const = 0;  // "a spring joint", as messages call it
    virtual std::unique_ptr<JointSpec> copy() const = 0;

    // Each point of a is tied to the nearest point of b within this distance [m]; a weld ties each point of b once.
    virtual double reach() const { return HUGE_VAL; }
    // Whether two points of one body may be tied.
    virtual bool tiesWithin() const { return false; }
    // Whether points come to one place. If they never have to come apart, they become one point or are held by their
    // collider, and tie() and carry() are not called.
    virtual bool isWeld() const { return false; }
    // Whether both sides are rows of edges, whose points are paired by their share of the length, all of them, and
    // whose cells beside it do not touch each other.
    virtual bool isSeam() const { return false; }
    // Whether it is one tie at `place` between two bodies, or a body and a collider, which mount() makes and not tie()
    // and carry().
    virtual bool isMounted() const { return false; }
    virtual void mount(IslandPlan& /*plan*/, const Mounting& /*at*/) const {}
    // Adds to the plan springs or constraints that tie two places on its bodies, `distance` [m] apart. A place is a
    // point, or between points if it is `place` on a rigid body, has a name, or is on a seam.
    virtual void tie(IslandPlan& plan, const Spot& a, const Spot& b, double distance) const = 0;
    // The same between a place on a body and a collider. The rigid grip has the point nearest to it, the present pose
    // of the collider, and the place there: `place`, or that of the point.
    virtual void carry(IslandPlan& plan, const Spot& end, Grip grip) const = 0;

    // The same for every kind.
    bool mayLetGo() const { return !name.empty() || breakForce; }
    bool isDrawn() const { return look.finish.has_value(); }
    // Whether each of its ties has to be known by itself.
    bool hasOwnTies() const { return mayLetGo() || isDrawn() || touch; }
};

}  // namespace taut::world
