// Flags with a form of their own, as plain values. It knows no command.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace taut::game {

struct FrameRange {
    std::int64_t first = 0;
    std::optional<std::int64_t> last;  // included; none: to the end
};

// "120", "120-239" or "120-"; throws core::Error(usage).
FrameRange frameRange(const std::string& text);

struct Size {
    int width = 0, height = 0;  // [px]
};

// "1280x720", each side 1 … 16384; throws core::Error(usage).
Size pictureSize(const std::string& text);

}  // namespace taut::game
