// Writes changed values into the text of a scene where they stand, so that every other byte stays as it was: comments,
// layout, line ends. It knows TOML, not what the keys mean.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace taut::scene {

struct Change {
    std::string key;    // dotted path: "cloth.flag.cells", "net.cradle.springs.3.damping_time_s"
    std::string value;  // as TOML: "[12, 8]", "\"leapfrog\"", "0.5"
};

// The text with the changes in it. A value that is there is replaced where it stands; of a list that keeps its length
// only the elements that differ are, so that comments between them stay, while a list of another length is replaced
// whole, with what is said inside it. A key that is not is added
// behind the last one of its table, in braces where the table is written so, and a table that is not there at the end.
// Throws core::Error(badContent) when the text is not TOML, and when the result would not read as the old content with
// just these values changed.
std::string spliced(std::string_view text, std::span<const Change> changes);

}  // namespace taut::scene
