// The shipped fabrics, as assets/fabrics has them.
#pragma once

#include <span>

namespace taut::web {

struct Fabric {
    const char *file, *text;  // "silk.toml"
};
extern const std::span<const Fabric> fabrics;

}  // namespace taut::web
