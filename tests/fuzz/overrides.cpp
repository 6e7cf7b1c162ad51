#include <algorithm>

#include "fuzz/support.h"

// A line is the value of one --set.
void taut::fuzz::readOverrides(View bytes) {
    scene::LoadOptions options = alone();
    std::string_view text = textOf(bytes);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        options.overrides.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    scene::loadSceneText(smallScene, "fuzz.toml", options);
}
