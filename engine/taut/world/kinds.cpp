#include "taut/spec/kinds.h"

// One line for each kind, in the order of the manual: its table, and the function that returns its row, in a file of
// its own.
#define TAUT_KINDS(KIND)                   \
    KIND(BodySpec, bodies, clothKind)      \
    KIND(BodySpec, bodies, ropeKind)       \
    KIND(BodySpec, bodies, blockKind)      \
    KIND(BodySpec, bodies, netKind)        \
    KIND(BodySpec, bodies, solidKind)      \
    KIND(JointSpec, joints, weldKind)      \
    KIND(JointSpec, joints, springKind)    \
    KIND(JointSpec, joints, rodKind)       \
    KIND(JointSpec, joints, hingeKind)     \
    KIND(JointSpec, joints, ballKind)      \
    KIND(JointSpec, joints, sliderKind)    \
    KIND(ForceSpec, forces, anchorKind)    \
    KIND(ForceSpec, forces, windKind)      \
    KIND(ForceSpec, forces, fillingKind)   \
    KIND(ActionSpec, actions, grabKind)    \
    KIND(ActionSpec, actions, moveKind)    \
    KIND(ActionSpec, actions, releaseKind) \
    KIND(ActionSpec, actions, pushKind)    \
    KIND(ActionSpec, actions, holdKind)    \
    KIND(ActionSpec, actions, freeKind)    \
    KIND(ActionSpec, actions, cutKind)     \
    KIND(ActionSpec, actions, addMassKind) \
    KIND(ActionSpec, actions, rampKind)    \
    KIND(ActionSpec, actions, spawnKind)

namespace taut::world {

#define TAUT_DECLARE(Spec, table, kind) Kind<Spec> kind();
TAUT_KINDS(TAUT_DECLARE)
#undef TAUT_DECLARE

Kinds builtIn() {
    Kinds kinds;
#define TAUT_ADD(Spec, table, kind) kinds.table.add(kind());
    TAUT_KINDS(TAUT_ADD)
#undef TAUT_ADD
    kinds.methods = ode::builtInMethods();
    kinds.shapes = collision::builtInShapes();
    return kinds;
}

const KindTable<ActionSpec>& builtInActions() {
    static const KindTable<ActionSpec> actions = builtIn().actions;
    return actions;
}

}  // namespace taut::world
