// Lays what a scenario says over the scene that it names, and that over the one that it names. It knows trees of keys,
// not what they mean.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "taut/fields/private/problems.h"
#include "taut/scene/private/document.h"
#include "taut/scene/private/text_file.h"

namespace taut::scene {

using fields::Problems;

// The tree of `base` with that of `over` laid on: tables deeply, everything else replaced. Places stay those of the
// file that says it; a table that both have begins where the base has it.
Node merged(Node base, const Node& over);

// What `scene = "…"` says: the name, and whether it is one of the shipped scenes whatever lies beside the file, as
// "shipped:NAME" says.
struct BaseName {
    std::string name;
    bool isShipped = false;
};
BaseName nameOfBase(std::string_view value);

struct BaseFile {
    std::filesystem::path path;  // empty: the scene names none, or there was a fault
    std::string text;
};

// The file that `scene = "…"` in a document names: beside the scene, or a shipped one in the `scenes` of an asset
// folder, of these alone with "shipped:" before it, with or without ".toml"; never the scene file itself. "shipped:"
// also takes a way from the asset folder, such as "shipped:scenarios/net". `chain` has the files so far, each of which
// builds on the next; the document is the last. Reports what is wrong with the name or the file, and a chain that is
// too long or goes in a circle.
BaseFile baseFileOf(const Node& root, const std::vector<std::filesystem::path>& chain,
                    const std::vector<std::filesystem::path>& assetFolders, const Confinement& confinement,
                    std::uint64_t maxBytes, Problems& problems);

// How many files a scene may build on, one upon another.
inline constexpr std::size_t mostBases = 8;

}  // namespace taut::scene
