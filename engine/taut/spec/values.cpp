// Special members of the structs of a scene; see core/value.h.
#include "taut/core/value.h"
#include "taut/spec/spec.h"

namespace taut::world {

TAUT_VALUE_MEMBERS(CameraSpec);
TAUT_VALUE_MEMBERS(CheckSpec);
TAUT_VALUE_MEMBERS(ColliderSpec);
TAUT_VALUE_MEMBERS(FinishSpec);
TAUT_VALUE_MEMBERS(FitSpec);
TAUT_VALUE_MEMBERS(FitTarget);
TAUT_VALUE_MEMBERS(GoldenSpec);
TAUT_VALUE_MEMBERS(LabelSpec);
TAUT_VALUE_MEMBERS(LampSpec);
TAUT_VALUE_MEMBERS(MeshData);
TAUT_VALUE_MEMBERS(SceneSpec);
TAUT_VALUE_MEMBERS(SolverOverride);
TAUT_VALUE_MEMBERS(SolverSpec);

TAUT_BASE_MEMBERS(ActionSpec);
TAUT_BASE_MEMBERS(ForceSpec);
TAUT_BASE_MEMBERS(JointSpec);

}  // namespace taut::world
