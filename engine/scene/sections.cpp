#include "taut/scene/sections.h"

namespace taut::scene {

std::vector<SceneSection> sceneSections() {
    return {fileSection(),       needSection(),   solverSection(),   worldSection(), runSection(),    pictureSection(),
            materialSection(),   clothSection(),  ropeSection(),     blockSection(), netSection(),    jointSection(),
            massSection(),       anchorSection(), colliderSection(), windSection(),  cameraSection(), lightSection(),
            backgroundSection(), labelSection(),  handSection(),     atSection(),    checkSection(),  goldenSection()};
}

}  // namespace taut::scene
