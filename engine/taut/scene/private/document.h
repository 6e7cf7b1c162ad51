// Makes a tree of a TOML text. It knows nothing of scenes.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "taut/fields/node.h"
#include "taut/fields/private/problems.h"

namespace taut::scene {

using fields::Member;
using fields::Node;
using fields::NodeKind;
using fields::Place;

// The first thing in a text that is not TOML.
struct SyntaxError : std::runtime_error {
    SyntaxError(Place where, const std::string& message, std::string better = {})
        : std::runtime_error(message), place(where), remedy(std::move(better)) {}
    Place place;
    std::string remedy;
};

// The tree of a text. Throws SyntaxError, also for zero bytes, invalid UTF-8, UTF-16, a key given twice, and nesting so
// deep that it can only be an accident or an attack.
Node documentTree(std::string_view text, int origin);

// The same, but reports text that is not TOML and throws core::Error(badContent) with all problems so far.
Node treeOf(std::string_view text, int origin, fields::Problems& problems);

}  // namespace taut::scene
