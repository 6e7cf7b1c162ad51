// Text for a picture: the labels of a scene at a moment, and their places.
#pragma once

#include <span>
#include <vector>

#include "taut/island/private/island.h"
#include "taut/spec/picture_spec.h"
#include "taut/view/frame_view.h"

namespace taut::world {

struct LabelSubject {
    const Body* body = nullptr;
    const Island* island = nullptr;  // its owner
};

// Adds a label at its place. A label of bodies appears above each subject, with a second line below if the body is
// frozen.
void addLabels(const LabelSpec& spec, std::span<const LabelSubject> subjects, std::vector<view::Label>& labels);

}  // namespace taut::world
