// A window that shows pictures and reports keys and the mouse. It knows no scene. SDL stays inside its source.
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
    std::string key;        // "space", "a", "f1", …: the name of the key in lower case
    bool isRepeat = false;  // the key is held down
    bool isLeft = false;    // press, release: the left button; else another one
    glm::dvec2 place{0.0};  // press, release, motion: in the picture, as shares of its width and height
    double amount = 0.0;    // wheel: turns away from the user
};

// How windows are shown here: "x11", "wayland". Opens none. Throws core::Error(noRenderer) without a display.
std::string windowDriver();

class Window {
  public:
    // The size is for a common screen. On a dense screen it has more pixels and looks the same. Throws
    // core::Error(noRenderer) without a display.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // The events since the last call.
    std::vector<WindowEvent> events();

    // Copies to the clipboard; false if there is none.
    bool copy(const std::string& text);

    double density() const;  // pixels for one pixel of a common screen

    // A window of another size shows the picture scaled, with the proportions with which it was made.
    void show(const image::Image& picture);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::game
