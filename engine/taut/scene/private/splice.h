// Writes changed values into the text of a scene at their places. Every other byte stays: comments, layout, line ends.
// It knows TOML, but not the meaning of keys.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace taut::scene {

struct Change {
    std::string key;    // dotted path: "cloth.flag.cells", "net.cradle.springs.3.damping_time_s"
    std::string value;  // as TOML: "[12, 8]", "\"leapfrog\"", "0.5"
};

// The text with the changes. An existing value is replaced in place. In a list that keeps its length only elements that
// differ are replaced, so comments between them stay. A list of another length is replaced whole, with its comments. A
// new key is added after the last one of its table, inside the braces if it has these; a new table is added at the end.
// Throws core::Error(badContent) if the text is not TOML, or if the result would not read as the old content with just
// these changes.
std::string spliced(std::string_view text, std::span<const Change> changes);

}  // namespace taut::scene
