// Any scene as a subject: played by the world, with method, step and precision overridden for all its bodies.
#pragma once

#include <memory>
#include <string>

#include "taut/study/subject.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// The largest step is a tick of the scene, and its times are whole ticks. The duration is what the scene says, at most
// two seconds. Throws what the world throws.
// Throws core::Error(badContent) when no point of it is free.
std::unique_ptr<Subject> makeSceneSubject(const world::SceneSpec& spec, const std::string& name);

}  // namespace taut::study
