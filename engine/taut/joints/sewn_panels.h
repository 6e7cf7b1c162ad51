// Sewn panels get as many points along a seam as the edges on its other side.
#pragma once

namespace taut::world {

struct SceneSpec;

// Gives sides of panels as many points as the edges have that seams sew them to, if the cells allow it. Throws
// core::Error(badContent) for bodies that cannot be built.
void evenSeams(SceneSpec& spec);

}  // namespace taut::world
