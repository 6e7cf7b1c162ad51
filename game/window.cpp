#include "game/window.h"

#include <SDL2/SDL.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "taut/core/error.h"

namespace taut::game {
namespace {

[[noreturn]] void failWithoutWindow(const char* what) {
    throw core::Error(core::ErrorKind::noRenderer, std::string(what) + " (" + SDL_GetError() + ")");
}

std::string nameOf(SDL_Keycode key) {
    std::string name = SDL_GetKeyName(key);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name;
}

// Without a display SDL would try drivers that show their windows nowhere; who asks for one by name gets it.
bool isThereADisplay() {
    const auto isSet = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value != nullptr && *value != '\0';
    };
    return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY") || isSet("SDL_VIDEODRIVER");
}

bool isOnWayland() {
    const char* driver = SDL_GetCurrentVideoDriver();
    return driver != nullptr && std::strcmp(driver, "wayland") == 0;
}

// X11 counts pixels only: how many a common screen would have, from the size that the screen reports. A screen that is
// no denser than that of most portable computers is as it is.
double densityOfScreen(int width, int height) {
    constexpr float common = 96.0F;  // [dots an inch]
    constexpr double least = 1.5, most = 3.0;
    if (isOnWayland()) return 1.0;
    float dots = 0.0F;
    SDL_Rect room{};
    if (SDL_GetDisplayDPI(0, &dots, nullptr, nullptr) != 0 || SDL_GetDisplayUsableBounds(0, &room) != 0) return 1.0;
    const double fits = std::min(static_cast<double>(room.w) / width, static_cast<double>(room.h) / height);
    const double density = std::round(4.0 * std::min(static_cast<double>(dots / common), most)) / 4.0;
    return density >= least && density <= fits ? density : 1.0;
}

// Of each call SDL_QuitSubSystem takes one back.
void reachDisplay() {
    if (!isThereADisplay()) throw core::Error(core::ErrorKind::noRenderer, "there is no display to open a window on");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) failWithoutWindow("the display takes no window");
}

}  // namespace

std::string windowDriver() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    reachDisplay();
    const char* const name = SDL_GetCurrentVideoDriver();
    std::string driver = name == nullptr ? "" : name;
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
    return driver;
}

struct Window::Impl {
    int width, height;  // on a common screen
    double density = 1.0;
    int textureWidth = 0, textureHeight = 0;
    SDL_Window* window = nullptr;
    SDL_Renderer* renderer = nullptr;
    SDL_Texture* texture = nullptr;

    ~Impl() {
        if (texture != nullptr) SDL_DestroyTexture(texture);
        if (renderer != nullptr) SDL_DestroyRenderer(renderer);
        if (window != nullptr) SDL_DestroyWindow(window);
        SDL_QuitSubSystem(SDL_INIT_VIDEO);
    }

    void fitTexture(int wide, int high) {
        if (texture != nullptr && textureWidth == wide && textureHeight == high) return;
        if (texture != nullptr) SDL_DestroyTexture(texture);
        texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STREAMING, wide, high);
        if (texture == nullptr) failWithoutWindow("a window takes no pictures");
        textureWidth = wide;
        textureHeight = high;
    }

    glm::dvec2 placeOf(int x, int y) const {
        return {(x + 0.5) / static_cast<double>(width), (y + 0.5) / static_cast<double>(height)};
    }

    std::optional<WindowEvent> read(const SDL_Event& event) const {
        using What = WindowEvent::What;
        WindowEvent result;
        switch (event.type) {
            case SDL_QUIT: return result;
            case SDL_KEYDOWN:
                result.what = What::key;
                result.key = nameOf(event.key.keysym.sym);
                result.isRepeat = event.key.repeat != 0;
                return result;
            case SDL_MOUSEBUTTONDOWN:
            case SDL_MOUSEBUTTONUP:
                result.what = event.type == SDL_MOUSEBUTTONDOWN ? What::press : What::release;
                result.isLeft = event.button.button == SDL_BUTTON_LEFT;
                result.place = placeOf(event.button.x, event.button.y);
                return result;
            case SDL_MOUSEMOTION:
                result.what = What::motion;
                result.place = placeOf(event.motion.x, event.motion.y);
                return result;
            case SDL_MOUSEWHEEL:
                result.what = What::wheel;
                result.amount = event.wheel.y;
                return result;
            case SDL_WINDOWEVENT:
                if (event.window.event != SDL_WINDOWEVENT_EXPOSED) return std::nullopt;
                result.what = What::exposed;
                return result;
            default: return std::nullopt;
        }
    }
};

Window::Window(const std::string& title, int width, int height) : impl_(new Impl{width, height}) {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    reachDisplay();
    // The pictures are drawn by the processor; so are they shown, with no need of another driver. Wayland takes no
    // pixels from SDL but by a driver.
    if (!isOnWayland()) {
        SDL_SetHintWithPriority(SDL_HINT_RENDER_DRIVER, "software", SDL_HINT_DEFAULT);
        SDL_SetHintWithPriority(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0", SDL_HINT_DEFAULT);
    }
    const double larger = densityOfScreen(width, height);
    const auto scaled = [&](int length) { return static_cast<int>(std::lround(length * larger)); };
    impl_->window = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, scaled(width),
                                     scaled(height), SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (impl_->window == nullptr) failWithoutWindow("a window cannot be opened");
    impl_->renderer = SDL_CreateRenderer(impl_->window, -1, 0);
    if (impl_->renderer == nullptr) failWithoutWindow("nothing can be shown in a window");
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    int pixels = 0;
    if (SDL_GetRendererOutputSize(impl_->renderer, &pixels, nullptr) == 0 && pixels > width)
        impl_->density = static_cast<double>(pixels) / width;
    // Places of the mouse are in pixels of the picture, for any size of the window.
    SDL_RenderSetLogicalSize(impl_->renderer, width, height);
}
Window::~Window() = default;

double Window::density() const {
    return impl_->density;
}

std::vector<WindowEvent> Window::events() {
    std::vector<WindowEvent> all;
    for (SDL_Event event; SDL_PollEvent(&event) != 0;)
        if (std::optional<WindowEvent> read = impl_->read(event)) all.push_back(std::move(*read));
    return all;
}

bool Window::copy(const std::string& text) {
    return SDL_SetClipboardText(text.c_str()) == 0;
}

void Window::show(const image::Image& picture) {
    TAUT_EXPECTS(picture.isWhole());
    // Where SDL shows by GL: another context has been current in this thread, of which it does not know.
    if (SDL_GL_GetCurrentContext() != nullptr) SDL_GL_MakeCurrent(impl_->window, nullptr);
    impl_->fitTexture(picture.width, picture.height);
    void* pixels = nullptr;
    int pitch = 0;
    if (SDL_LockTexture(impl_->texture, nullptr, &pixels, &pitch) != 0) failWithoutWindow("a picture cannot be shown");
    const std::size_t row = static_cast<std::size_t>(picture.width) * 3;
    for (int y = 0; y < picture.height; ++y)
        std::memcpy(static_cast<std::uint8_t*>(pixels) + static_cast<std::ptrdiff_t>(y) * pitch,
                    picture.rgb.data() + static_cast<std::size_t>(y) * row, row);
    SDL_UnlockTexture(impl_->texture);
    SDL_RenderClear(impl_->renderer);
    SDL_RenderCopy(impl_->renderer, impl_->texture, nullptr, nullptr);
    SDL_RenderPresent(impl_->renderer);
}

}  // namespace taut::game
