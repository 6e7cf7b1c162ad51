// Any scene as a subject: played by the world, with method, step and precision overridden for all its bodies.
#pragma once

#include <memory>
#include <string>

#include "taut/study/subject.h"

namespace taut::world {
struct SceneSpec;
}

namespace taut::study {

// The largest step is a tick of the scene, and its times are integer ticks. The duration is that of the scene, at most
// two seconds. Throws exceptions of the world, and core::Error(badContent) if no point of it is free.
std::unique_ptr<Subject> makeSceneSubject(const world::SceneSpec& spec, const std::string& name);

}  // namespace taut::study
