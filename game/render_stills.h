// Draws single moments of a scene, for `taut render --at`. It writes no video and keeps no record.
#pragma once

#include "game/render_flags.h"

namespace taut::game {

// Simulates from the start and draws the moments of RenderFlags::at on the way. Returns the exit code. Expects checked
// flags. Throws core::Error.
int renderStills(const RenderFlags& flags);

}  // namespace taut::game
