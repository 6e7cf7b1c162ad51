// Merges a scenario into the scene that it names, and that into the scene that it names in turn. It knows trees of
// keys, not their meaning.
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

// The tree of `base` with `over` on top: tables are merged deeply, everything else is replaced. Each place is that in
// its own file. A table in both begins where the base has it.
Node merged(Node base, const Node& over);

// The content of `scene = "…"`: the name, and whether "shipped:NAME" selects a shipped scene, with or without a file
// beside this one.
struct BaseName {
    std::string name;
    bool isShipped = false;
};
BaseName nameOfBase(std::string_view value);

struct BaseFile {
    std::filesystem::path path;  // empty: the scene names none, or there was a fault
    std::string text;
};

// The file that `scene = "…"` in a document names: one beside the scene, or a shipped one in the `scenes` of an asset
// folder. With "shipped:" only the latter counts. ".toml" may be left out. It is never the scene file itself.
// "shipped:" also takes a path from the asset folder, such as "shipped:scenarios/net". `chain` has the files so far,
// each of which builds on the next; the document is the last. Reports faults of the name or the file, and a chain that
// is too long or circular.
BaseFile baseFileOf(const Node& root, const std::vector<std::filesystem::path>& chain,
                    const std::vector<std::filesystem::path>& assetFolders, const Confinement& confinement,
                    std::uint64_t maxBytes, Problems& problems);

// The longest chain of files that build on one another.
inline constexpr std::size_t mostBases = 8;

}  // namespace taut::scene
