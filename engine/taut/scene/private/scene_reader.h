// Reads a document into the scene's structs, by the field table. References to other things are listed, not resolved.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/sections.h"
#include "taut/spec/spec.h"

namespace taut::scene {

// A text that refers to something, or a moment in time, with its place.
struct NameReference {
    Role role = Role::none;
    Place place;
    std::string text;   // for a mesh or a texture: the path as written
    double time = 0;    // [s]
    std::string owner;  // its section, "cloth.flag"; "environment" for a setting
};

struct ReadScene {
    world::SceneSpec spec;                  // sections in the order of the file
    std::vector<NameReference> references;  // in the order of the table
    std::set<std::string> faulty;           // owners with an error inside, "cloth.flag", "at[0]" or "fit"
    std::map<std::string, Place> owners;    // where "cloth.flag" or "joint[0]" begins
};

// world::Source names files and overrides as `problems` does.
ReadScene readScene(const Node& root, const std::vector<SceneSection>& sections, const std::string& fileName,
                    Problems& problems);

}  // namespace taut::scene
