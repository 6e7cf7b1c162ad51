// A force on bodies besides springs and gravity, as a scene names it. The kinds are in forces/.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "taut/spec/source.h"

namespace taut::world {

struct Body;
struct SceneSpec;
class Force;

struct ForceSpec {
    std::string name;  // without the kind: "breeze"
    Source source;

    ForceSpec();
    ForceSpec(const ForceSpec&);
    ForceSpec& operator=(const ForceSpec&);
    virtual ~ForceSpec();
    virtual std::string_view kind() const = 0;  // "wind"
    virtual std::unique_ptr<ForceSpec> copy() const = 0;
    std::string fullName() const { return std::string(kind()) + "." + name; }

    // The force with this full name in the present scene; null if it does nothing.
    virtual std::shared_ptr<const Force> make(const SceneSpec& scene) const = 0;
    // Throws core::Error(badContent), with file, line and column, if the force finds nothing to act on in any body.
    virtual void checkBodies(std::span<Body* const>) const {}
    // The points at which it pulls, KIND.NAME@SELECTOR; empty: surfaces, or all points.
    virtual std::string_view pulledPoints() const { return {}; }
    // Targets, e.g. "cloth.*", of the bodies that it surrounds with air.
    virtual std::vector<std::string> surroundedBodies() const { return {}; }
};

}  // namespace taut::world
