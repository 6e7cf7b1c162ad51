// Plays a scene in a window. Events become actions of the session, the camera and the recorder. Every turn of the loop
// draws a picture while the next ticks are computed. It knows neither the command line nor SDL.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/file_watch.h"
#include "game/play_figures.h"
#include "game/play_quality.h"
#include "game/play_screen.h"
#include "game/window.h"
#include "taut/live/adaptation.h"
#include "taut/live/orbit.h"
#include "taut/live/pace.h"
#include "taut/live/picking.h"
#include "taut/live/session.h"
#include "taut/pipeline/overlay.h"
#include "taut/render/renderer.h"
#include "taut/scene/load.h"

namespace taut::game {

struct PlaySettings {
    std::string scene;                   // as the user gave it
    std::vector<std::string> overrides;  // "key=value"
    int width = 512, height = 288;       // [px] on a common screen
    std::string quality = "auto";        // or a name of levelNamed()
    std::string gl;                      // as in the flag --gl; empty: the first that works
    int threads = 0;                     // 0: all threads of the machine
    double seconds = 0.0;                // [s] of wall time after which it ends; 0: the user ends it
    bool records = false;                // from the start
    bool watches = false;                // reads the scene again when one of its files changes
    std::filesystem::path record;        // the file to write; empty: named after the scene, in the current folder
    bool isQuiet = false;                // only errors appear on standard error
    bool isVerbose = false;              // every action appears on standard error
};

class LivePlay {
  public:
    // Throws core::Error for a faulty scene, noRenderer without a display.
    explicit LivePlay(PlaySettings settings);

    // Runs until the user ends it, the time is over or `stop` is set. Then writes the current recording.
    void run(const std::atomic<bool>& stop);

  private:
    using Clock = std::chrono::steady_clock;

    scene::Loaded readScene(const std::vector<std::string>& changes) const;
    void rebuild(std::vector<std::string> changes, const std::string& said);
    void reload();
    std::unique_ptr<live::Session> goingOn(const scene::Loaded& scene) const;
    std::string follow(scene::Loaded scene);
    void adopt(std::unique_ptr<live::Session> session, scene::StateKeys keys);
    std::string keptRecording();
    void watchFiles(bool isBroken);
    void handle(const WindowEvent& event);
    void press(const std::string& key, bool isRepeat);
    void beginDrag(const WindowEvent& event);
    void drag(const WindowEvent& event);
    void lead();
    void findName();
    void copyName();
    void nextMethod();
    void changeStep(double factor);
    void toggleRecording();
    void writeRecording();
    std::string savedRecording(bool goesOn);
    void say(const std::string& text);
    void report();
    int ticksDue(double wall);
    void drawPicture(const view::FrameView& view, double wall);
    void makeLevels();
    void adapt(double drawing, double turn);
    void moveFigures(const view::FrameView& view, double wall);
    std::optional<glm::vec2> hand() const;
    std::optional<NamedPoint> named() const;
    std::string qualityText() const;
    view::Camera camera() const;
    std::vector<std::string> marks() const;
    void printSummary(double seconds) const;

    PlaySettings settings_;
    std::vector<std::string> changes_;  // overrides by keys, applied after those of the settings
    std::unique_ptr<Window> window_;
    int width_ = 0, height_ = 0;        // [px] of the window
    std::vector<DrawingLevel> levels_;  // one if the quality is fixed
    std::optional<live::Adaptation> adaptation_;
    std::unique_ptr<render::Renderer> renderer_;
    std::unique_ptr<live::Session> session_;
    scene::StateKeys keys_;  // of its scene
    FileWatch files_;        // of its scene, if it is watched
    std::unique_ptr<pipeline::Overlay> overlay_;
    live::Pace pace_{1.0};
    live::Orbit orbit_;
    PlayScreen screen_;
    std::optional<live::PickedPoint> named_;  // under the mouse, if names are shown
    FiguresPlace figures_;
    pipeline::PictureBox covered_;  // [px] covered by the figures

    enum class Dragging { nothing, point, view };
    Dragging dragging_ = Dragging::nothing;
    glm::dvec2 mouse_{0.5};     // [shares of the picture]
    std::string heldBody_;      // the body of the held point
    glm::dvec3 held_{0.0};      // [m] to where the mouse moves the held point
    glm::dvec3 offset_{0.0};    // [m] from the place on the ray to that point
    view::Camera shownCamera_;  // the scene's camera in the shown picture

    bool isOver_ = false, isPaused_ = false, showsMarks_ = false, showsOverlay_ = true, isRecording_ = false;
    bool showsNames_ = false;
    bool hasChanged_ = true;  // since the last picture
    int steps_ = 0;           // single ticks that are asked for
    int slowness_ = 0;        // motion is slower by 2 to the power of this
    bool hasReportedDivergence_ = false;
    std::size_t printed_ = 0;  // number of deeds printed
    std::int64_t pictures_ = 0, ticks_ = 0;
    double rate_ = 0.0;     // [pictures/s] lately
    double drawing_ = 0.0;  // [s] for the last picture
};

}  // namespace taut::game
