#include "taut/spec/kinds.h"

// One line for each kind, in the order of the manual: the function that returns its row, in a file of its own.
#define TAUT_BODIES(KIND) \
    KIND(clothKind)       \
    KIND(ropeKind)        \
    KIND(blockKind)       \
    KIND(netKind)         \
    KIND(solidKind)
#define TAUT_JOINTS(KIND) \
    KIND(weldKind)        \
    KIND(springKind)      \
    KIND(rodKind)         \
    KIND(hingeKind)       \
    KIND(ballKind)
#define TAUT_FORCES(KIND) \
    KIND(anchorKind)      \
    KIND(windKind)        \
    KIND(fillingKind)
#define TAUT_ACTIONS(KIND) \
    KIND(grabKind)         \
    KIND(moveKind)         \
    KIND(releaseKind)      \
    KIND(pushKind)         \
    KIND(holdKind)         \
    KIND(freeKind)         \
    KIND(cutKind)          \
    KIND(addMassKind)      \
    KIND(rampKind)         \
    KIND(spawnKind)

namespace taut::world {

#define TAUT_BODY(kind) Kind<BodySpec> kind();
#define TAUT_JOINT(kind) Kind<JointSpec> kind();
#define TAUT_FORCE(kind) Kind<ForceSpec> kind();
#define TAUT_ACTION(kind) Kind<ActionSpec> kind();
TAUT_BODIES(TAUT_BODY)
TAUT_JOINTS(TAUT_JOINT)
TAUT_FORCES(TAUT_FORCE)
TAUT_ACTIONS(TAUT_ACTION)
#undef TAUT_BODY
#undef TAUT_JOINT
#undef TAUT_FORCE
#undef TAUT_ACTION

Kinds builtIn() {
    Kinds kinds;
#define TAUT_BODY(kind) kinds.bodies.add(kind());
#define TAUT_JOINT(kind) kinds.joints.add(kind());
#define TAUT_FORCE(kind) kinds.forces.add(kind());
#define TAUT_ACTION(kind) kinds.actions.add(kind());
    TAUT_BODIES(TAUT_BODY)
    TAUT_JOINTS(TAUT_JOINT)
    TAUT_FORCES(TAUT_FORCE)
    TAUT_ACTIONS(TAUT_ACTION)
#undef TAUT_BODY
#undef TAUT_JOINT
#undef TAUT_FORCE
#undef TAUT_ACTION
    kinds.methods = ode::builtInMethods();
    kinds.shapes = collision::builtInShapes();
    return kinds;
}

const KindTable<ActionSpec>& builtInActions() {
    static const KindTable<ActionSpec> actions = builtIn().actions;
    return actions;
}

}  // namespace taut::world
