#include "taut/world/kinds.h"

// A line a kind, in the order of the manual: the function that returns its row, in a file of its own.
#define TAUT_BODIES(KIND) \
    KIND(clothKind)       \
    KIND(ropeKind)        \
    KIND(blockKind)       \
    KIND(netKind)
#define TAUT_FORCES(KIND) \
    KIND(anchorKind)      \
    KIND(windKind)

namespace taut::world {

#define TAUT_BODY(kind) Kind<BodySpec> kind();
#define TAUT_FORCE(kind) Kind<ForceSpec> kind();
TAUT_BODIES(TAUT_BODY)
TAUT_FORCES(TAUT_FORCE)
#undef TAUT_BODY
#undef TAUT_FORCE

Kinds builtIn() {
    Kinds kinds;
#define TAUT_BODY(kind) kinds.bodies.add(kind());
#define TAUT_FORCE(kind) kinds.forces.add(kind());
    TAUT_BODIES(TAUT_BODY)
    TAUT_FORCES(TAUT_FORCE)
#undef TAUT_BODY
#undef TAUT_FORCE
    kinds.methods = ode::builtInMethods();
    kinds.shapes = collision::builtInShapes();
    return kinds;
}

}  // namespace taut::world
