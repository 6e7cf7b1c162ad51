// The rows of the field table, by topic; sceneSections() joins them. Each function is the table of one section.
#pragma once

#include "taut/scene/field.h"

namespace taut::scene {

// Limits that many fields share.
inline constexpr Range placeRange{-1e6, 1e6};   // [m]
inline constexpr Range lengthRange{1e-6, 1e6};  // [m]
inline constexpr Range momentRange{0.0, 1e6};   // [s]

// Settings of the whole scene.
Section fileSection();
Section needSection();
Section solverSection();
Section worldSection();
Section runSection();
Section pictureSection();
Section lightSection();
Section backgroundSection();

// What moves by its own laws.
Section materialSection();
Section clothSection();
Section ropeSection();
Section blockSection();
Section netSection();

// What ties, pushes and shows it.
Section jointSection();
Section massSection();
Section anchorSection();
Section colliderSection();
Section windSection();
Section cameraSection();
Section labelSection();

// What happens while it runs, and what is claimed of it.
Section handSection();
Section atSection();
Section checkSection();
Section goldenSection();

// Parts of several sections.
Section finishSection();
std::vector<std::string> easeNames();
std::vector<std::string> lumpingNames();

// Keys must ascend in t. Reports each that does not; `list` is the value of `keys`.
void checkAscending(const CheckInput& input);

// Enters a new element with a name and a source.
template <class Spec>
auto enterNamed(std::vector<Spec> world::SceneSpec::*list) {
    return [list](world::SceneSpec& scene, const std::string& name, const world::Source& source) -> void* {
        Spec& spec = (scene.*list).emplace_back();
        if constexpr (requires { spec.name; }) spec.name = name;
        spec.source = source;
        return &spec;
    };
}

// Finds an element by its name.
template <class Spec>
auto findNamed(std::vector<Spec> world::SceneSpec::*list) {
    return [list](world::SceneSpec& scene, const std::string& name) -> void* {
        for (Spec& spec : scene.*list)
            if (spec.name == name) return &spec;
        return nullptr;
    };
}

template <class Part>
auto findPart(Part world::SceneSpec::*part) {
    return [part](world::SceneSpec& scene, const std::string&) -> void* { return &(scene.*part); };
}

// Enters a part of the scene that exists once.
template <class Part>
auto enterPart(Part world::SceneSpec::*part) {
    return
        [part](world::SceneSpec& scene, const std::string&, const world::Source&) -> void* { return &(scene.*part); };
}

}  // namespace taut::scene
