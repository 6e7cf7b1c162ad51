// The actions of keys and the mouse.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "game/live_play.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "taut/core/private/contains.h"
#include "taut/core/whole_file.h"
#include "taut/live/recording.h"
#include "taut/spec/common_rows.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

constexpr double turnPerWidth = 4.0;  // [rad] for a drag from edge to edge
constexpr double zoomPerNotch = 0.88;
constexpr int slowest = 4;  // 1/16

// The first of NAME.toml, NAME-1.toml, … that is not there yet; of NAME-1.toml, … where NAME.toml is kept for later.
std::filesystem::path freeName(const std::filesystem::path& wish, bool isKept) {
    std::filesystem::path name = wish;
    for (int i = 1; core::isThere(name) || (isKept && name == wish); ++i)
        name = wish.parent_path() / fmt::format("{}-{}.toml", wish.stem().string(), i);
    return name;
}

}  // namespace

void LivePlay::handle(const WindowEvent& event) {
    using What = WindowEvent::What;
    hasChanged_ = hasChanged_ || event.what != What::motion || dragging_ != Dragging::nothing || showsNames_;
    switch (event.what) {
        case What::quit: isOver_ = true; return;
        case What::key: return press(event.key, event.isRepeat);
        case What::press:
            mouse_ = event.place;
            if (dragging_ != Dragging::nothing) return;
            return event.isLeft ? beginDrag(event) : void(dragging_ = Dragging::view);
        case What::motion: return drag(event);
        case What::release:
            if (dragging_ == Dragging::point && event.isLeft) {
                session_->hand().release();
                say("released");
            }
            if (event.isLeft == (dragging_ == Dragging::point)) dragging_ = Dragging::nothing;
            return;
        case What::wheel: return orbit_.zoom(std::pow(zoomPerNotch, event.amount), camera());
        case What::exposed: return;
    }
}

void LivePlay::press(const std::string& key, bool isRepeat) {
    if (isRepeat && key != ".") return;
    const auto is = [&](std::initializer_list<const char*> names) { return core::contains(names, key); };
    if (is({"q", "escape"})) isOver_ = true;
    if (is({"space"})) isPaused_ = !isPaused_;
    if (is({"."})) {
        isPaused_ = true;
        ++steps_;
    }
    if (is({"s"})) slowness_ = slowness_ == slowest ? 0 : slowness_ + 1;
    if (is({"["})) slowness_ = std::min(slowness_ + 1, slowest);
    if (is({"]"})) slowness_ = std::max(slowness_ - 1, 0);
    if (is({"backspace"})) rebuild(changes_, "from the start");
    if (is({"m"})) nextMethod();
    if (is({"+", "=", "keypad +"})) changeStep(0.5);
    if (is({"-", "keypad -"})) changeStep(2.0);
    if (is({"d"})) session_->showMarks(showsMarks_ = !showsMarks_);
    if (is({"o"})) showsOverlay_ = !showsOverlay_;
    if (is({"c"})) orbit_.follow();
    if (is({"r"})) toggleRecording();
    if (is({"n"})) showsNames_ = !showsNames_;
    if (is({"y"})) copyName();
    if (is({"h", "f1"})) screen_.toggleHelp();
}

void LivePlay::beginDrag(const WindowEvent& event) {
    const live::Ray ray = live::rayThrough(camera(), event.place, 1.0 * settings_.width / settings_.height);
    const std::optional<live::PickedPoint> picked =
        live::pick(ray, session_->now().surfaces, session_->bodies(), live::pickReach);
    if (!picked) return;
    session_->grab(*picked);
    held_ = picked->position;
    offset_ = picked->position - live::onPicturePlane(ray, camera(), picked->position);
    dragging_ = Dragging::point;
    heldBody_ = picked->body;
    say("holding " + live::nameOf(*picked));
}

void LivePlay::drag(const WindowEvent& event) {
    const glm::dvec2 by = event.place - mouse_;
    mouse_ = event.place;
    if (dragging_ == Dragging::view)
        orbit_.turn(turnPerWidth * by.x, turnPerWidth * by.y * settings_.height / settings_.width, camera());
}

// The mouse leads the held point in the plane parallel to the picture, also when it rests and the camera moves.
void LivePlay::lead() {
    if (dragging_ != Dragging::point) return;
    const live::Ray ray = live::rayThrough(camera(), mouse_, 1.0 * settings_.width / settings_.height);
    const glm::dvec3 place = live::onPicturePlane(ray, camera(), held_ - offset_) + offset_;
    held_ = place;
    session_->hand().leadTo(place);
}

// The point under the mouse now, also a held one.
void LivePlay::findName() {
    named_.reset();
    if (!showsNames_ || dragging_ == Dragging::view) return;
    const live::Ray ray = live::rayThrough(camera(), mouse_, 1.0 * settings_.width / settings_.height);
    named_ = live::pick(ray, session_->now().surfaces, session_->bodies(true), live::pickReach);
}

void LivePlay::copyName() {
    if (!named_)
        return say(showsNames_ ? "there is no point under the mouse" : "n shows names, y copies the one shown");
    say(window_->copy(live::nameOf(*named_)) ? "copied " + live::nameOf(*named_) : "there is no clipboard");
}

void LivePlay::nextMethod() {
    const std::vector<std::string> names = world::methodNames();
    const auto now = std::ranges::find(names, session_->spec().solver.integrator);
    const std::string next = now == names.end() || now + 1 == names.end() ? names.front() : *(now + 1);
    std::vector<std::string> changes = changes_;
    std::erase_if(changes, [](const std::string& change) { return change.starts_with("solver.integrator="); });
    changes.push_back(fmt::format("solver.integrator=\"{}\"", next));
    rebuild(std::move(changes), "from the start with " + next);
}

void LivePlay::changeStep(double factor) {
    const double tick = session_->world().tickSeconds();
    const double substeps = std::max(1.0, std::round(tick / pipeline::smallestStep(session_->world()).step));
    const double wanted = std::max(1.0, std::round(substeps / factor));
    std::vector<std::string> changes = changes_;
    std::erase_if(changes, [](const std::string& change) { return change.starts_with("solver.dt="); });
    changes.push_back(fmt::format("solver.dt={:.6g}", 1.00001 * tick / wanted));  // at most; rounded to whole substeps
    rebuild(std::move(changes), fmt::format("from the start with h = {:.3g} ms", 1e3 * tick / wanted));
}

void LivePlay::toggleRecording() {
    if (isRecording_) return writeRecording();
    isRecording_ = true;
    say(session_->tick() == 0 ? "recording; r writes the file"
                              : "recording, all since the start of this run; r writes");
}

void LivePlay::writeRecording() {
    isRecording_ = false;
    say(savedRecording(false));
}

std::string LivePlay::savedRecording(bool goesOn) {
    const std::string refusal = "a run that diverged is not recorded";
    if (session_->divergence()) return refusal;
    dragging_ = Dragging::nothing;
    live::Recording recording = session_->record();
    report();
    if (session_->divergence()) return refusal;
    const std::filesystem::path scene = sceneFile(settings_.scene);
    const std::filesystem::path file = freeName(
        settings_.record.empty() ? std::filesystem::path(scene.stem().string() + "-played.toml") : settings_.record,
        goesOn);
    recording.scene = referenceTo(scene, file.parent_path());
    for (const auto& changes : {settings_.overrides, changes_})
        recording.overrides.insert(recording.overrides.end(), changes.begin(), changes.end());
    core::writeWholeFile(file, live::scenarioText(recording));
    const std::string what = fmt::format("{}: {} actions, state hash {:016x} at tick {}", file.string(),
                                         recording.deeds.size(), recording.hash, recording.endTick);
    printResult("{}\n", what);
    std::fflush(stdout);
    return "wrote " + file.string();
}

}  // namespace taut::game
