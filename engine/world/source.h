// Where something was written, and the words that several parts of a scene share.
#pragma once

#include <string>

namespace taut::world {

// Where in its file something was written, for messages that come later than loading.
struct Source {
    std::string file;
    int line = 0;
    int column = 0;
};

// Ways from one key to the next, as animators name them.
enum class Ease { linear, smooth, in, out, hold };

}  // namespace taut::world
