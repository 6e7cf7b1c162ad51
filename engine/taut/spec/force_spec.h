// What acts on bodies besides their springs and gravity, as a scene names it. The kinds are in forces/.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "taut/spec/source.h"

namespace taut::world {

struct Body;
struct SceneSpec;
class Force;

struct ForceSpec {
    std::string name;  // without the kind: "breeze"
    Source source;

    ForceSpec() = default;
    ForceSpec(const ForceSpec&) = default;
    ForceSpec& operator=(const ForceSpec&) = default;
    virtual ~ForceSpec() = default;
    virtual std::string_view kind() const = 0;  // "wind"
    virtual std::unique_ptr<ForceSpec> copy() const = 0;
    std::string fullName() const { return std::string(kind()) + "." + name; }

    // The force, of that full name, in the scene as it is; null where it does nothing.
    virtual std::shared_ptr<const Force> make(const SceneSpec& scene) const = 0;
    // Throws core::Error(badContent), with file, line and column, where none of the bodies has what it acts on.
    virtual void checkBodies(std::span<Body* const>) const {}
    // The points that it pulls at, KIND.NAME@SELECTOR; empty: surfaces, or all.
    virtual std::string_view pulledPoints() const { return {}; }
};

}  // namespace taut::world
