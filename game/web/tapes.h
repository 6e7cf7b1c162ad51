// Tapes of runs from their start, as `taut record` makes and `taut replay` reads them.
#pragma once

#include "game/web/object.h"

namespace taut::web {

// With text, name, overrides and ticks: the bytes of a tape, valid until the next call.
Json recordedTape(const Json& with);

// With bytes: plays the scene of the tape and returns its number of ticks, and the first difference, if any.
Json replayedTape(const Json& with);

}  // namespace taut::web
