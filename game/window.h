// A window that shows pictures and hears of keys and the mouse. It knows no scene; SDL stays inside its source.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "taut/image/image.h"

namespace taut::game {

struct WindowEvent {
    enum class What { quit, key, press, release, motion, wheel, exposed };
    What what = What::quit;
    std::string key;        // "space", "a", "f1", …: the key's name in small letters
    bool isRepeat = false;  // of a key that is held down
    bool isLeft = false;    // press, release: the left button; else another
    glm::dvec2 place{0.0};  // press, release, motion: in the picture, as shares of its width and height
    double amount = 0.0;    // wheel: turned away from the user
};

// By what windows are shown here: "x11", "wayland". Opens none; throws core::Error(noRenderer) without a display.
std::string windowDriver();

class Window {
  public:
    // Of that size on a common screen; on a dense one it has more pixels, and looks the same. Throws
    // core::Error(noRenderer) without a display.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // What happened since the last call.
    std::vector<WindowEvent> events();

    // To the clipboard; false where there is none.
    bool copy(const std::string& text);

    double density() const;  // pixels for one of a common screen

    // A window of another size shows it scaled, with the proportions that it was made with.
    void show(const image::Image& picture);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::game
