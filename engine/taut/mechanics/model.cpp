#include "taut/mechanics/model.h"

namespace taut::mechanics {

TAUT_VALUE_MEMBERS(Model);

}  // namespace taut::mechanics
