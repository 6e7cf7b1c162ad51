// Where in its file something was written, for messages that come later than loading.
#pragma once

#include <string>

namespace taut::core {

struct Source {
    std::string file;
    int line = 0;
    int column = 0;
    bool operator==(const Source&) const = default;
};

}  // namespace taut::core
