#include "game/live_play.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "game/folders.h"
#include "game/messages.h"
#include "game/renderers.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/live/between.h"

namespace taut::game {
namespace {

constexpr int mostTicks = 8;               // a picture
constexpr double tickBudget = 0.037;       // [s] of wall time for the ticks of a picture: 25 pictures a second
constexpr double leastPicture = 1.0 / 60;  // [s] no display shows more
constexpr double idlePause = 0.012;        // [s] between looks for events while nothing changes

// The scene's picture as the window has it.
world::PictureSpec pictureOf(const PlaySettings& settings, world::PictureSpec picture) {
    picture.size = {settings.width, settings.height};
    if (settings.samples > 0) picture.samples = settings.samples;
    if (settings.shadowSize > 0) picture.shadowSize = settings.shadowSize;
    return picture;
}

std::string titleOf(const std::string& scene) {
    return "taut play " + scene;
}

}  // namespace

LivePlay::LivePlay(PlaySettings settings) : settings_(std::move(settings)) {
    rebuild({}, "");
    window_ = std::make_unique<Window>(titleOf(settings_.scene), settings_.width, settings_.height);
    renderer_ = makeRenderer(pictureOf(settings_, session_->spec().picture), settings_.threads);
    isRecording_ = settings_.records;
    screen_.say("h: help", 5.0);
}

// A new world from the start; the old one stays when the scene cannot be built so.
void LivePlay::rebuild(std::vector<std::string> changes, const std::string& said) {
    std::vector<std::string> overrides = settings_.overrides;
    overrides.insert(overrides.end(), changes.begin(), changes.end());
    std::string kept;  // of the recording so far, which is not to be lost
    try {
        world::SceneSpec spec = readScene(settings_.scene, overrides);
        if (!settings_.isQuiet) notePreparation(spec);
        auto session = std::make_unique<live::Session>(std::move(spec), settings_.threads);
        if (session_ && isRecording_ && session_->tick() > 0) kept = savedRecording(true) + "; ";
        session_ = std::move(session);
    } catch (const core::Error& error) {
        if (!session_) throw;
        const std::string message = error.what();
        return say("That cannot be: " + message.substr(0, message.find('\n')));
    }
    changes_ = std::move(changes);
    for (const std::string& warning : session_->world().warnings())
        if (!settings_.isQuiet) printWarnings({warning});
    overlay_ = std::make_unique<pipeline::Overlay>(fontFile(), pipeline::smallestStep(session_->world()));
    overlay_->add({session_->metrics(), session_->tick()});
    pace_ = live::Pace(session_->world().tickSeconds());
    session_->showMarks(showsMarks_);
    shownCamera_ = session_->now().camera;
    dragging_ = Dragging::nothing;
    saidDivergence_ = false;
    printed_ = 0;
    steps_ = 0;
    hasChanged_ = true;
    if (!said.empty()) say(kept + said + (isRecording_ ? "; the recording starts anew" : ""));
}

void LivePlay::run(const std::atomic<bool>& stop) {
    const auto start = Clock::now();
    auto last = start;
    const auto secondsSince = [](Clock::time_point then) {
        return std::chrono::duration<double>(Clock::now() - then).count();
    };
    while (!isOver_ && !stop && (settings_.seconds <= 0.0 || secondsSince(start) < settings_.seconds)) {
        for (const WindowEvent& event : window_->events()) handle(event);
        if (isOver_) break;
        const bool wasSaying = screen_.isSaying();
        if (isPaused_ && steps_ == 0 && !hasChanged_ && !wasSaying) {
            std::this_thread::sleep_for(std::chrono::duration<double>(idlePause));
            last = Clock::now();
            continue;
        }
        const double wall = secondsSince(last);
        last = Clock::now();
        if (wall > 0.0) rate_ += (1.0 - std::exp(-2.0 * wall)) * (1.0 / wall - rate_);

        const double share = isPaused_ ? 1.0 : pace_.share();
        view::FrameView view = live::between(session_->before(), session_->now(), share);
        shownCamera_ = view.camera;
        view.camera = camera();
        lead();
        const std::int64_t before = session_->tick();
        hasChanged_ = wasSaying;  // its end is to be seen
        session_->begin(ticksDue(wall), tickBudget);
        drawPicture(view);
        session_->wait();
        report();
        ticks_ += session_->tick() - before;
        if (session_->tick() != before) {
            overlay_->add({session_->metrics(), session_->tick()});
            hasChanged_ = true;
        }
        if (const double left = leastPicture - secondsSince(last); left > 0.0)
            std::this_thread::sleep_for(std::chrono::duration<double>(left));
    }
    if (isRecording_) writeRecording();
    printSummary(secondsSince(start));
}

int LivePlay::ticksDue(double wall) {
    if (isPaused_) return std::exchange(steps_, 0);
    return pace_.due(std::min(wall, 1.0), 1.0 / static_cast<double>(1 << slowness_), mostTicks);
}

void LivePlay::drawPicture(const view::FrameView& view) {
    image::Image picture = renderer_->draw(view);
    if (showsOverlay_) {
        const world::SolverSpec& solver = session_->spec().solver;
        const std::vector<pipeline::OverlayLine> above = {{fmt::format("{:.0f} pictures/s", rate_), solver.integrator}};
        overlay_->paint(picture, view.time + session_->world().tickSeconds(), above);
    }
    screen_.paint(picture, overlay_->letters(), marks());
    window_->show(picture);
    ++pictures_;
}

std::vector<std::string> LivePlay::marks() const {
    std::vector<std::string> marks;
    if (isRecording_) marks.emplace_back("● recording");
    if (session_->divergence()) marks.emplace_back("diverged");
    if (isPaused_) marks.emplace_back("paused");
    if (slowness_ > 0) marks.push_back(fmt::format("1/{} speed", 1 << slowness_));
    return marks;
}

view::Camera LivePlay::camera() const {
    return orbit_.camera(shownCamera_);
}

void LivePlay::say(const std::string& text) {
    screen_.say(text);
    hasChanged_ = true;
    if (!settings_.isQuiet) printNote("{}\n", text);
}

// What the ticks just done brought to light.
void LivePlay::report() {
    for (const std::string& fault : session_->takeFaults()) say(fault.substr(0, fault.find('\n')));
    const auto& deeds = session_->deeds();
    for (; printed_ < deeds.size(); ++printed_)
        if (settings_.isVerbose)
            printNote("{}\n", live::actionText(deeds[printed_], deeds[printed_].t, world::builtInActions()));
    if (!session_->divergence() || saidDivergence_) return;
    saidDivergence_ = true;
    printNote("{}\n", session_->divergence()->message);
    screen_.say(
        fmt::format("Diverged at {:.3f} s: backspace starts again, + halves the step", session_->divergence()->time),
        1e6);
}

void LivePlay::printSummary(double seconds) const {
    const double moved = static_cast<double>(ticks_) * session_->world().tickSeconds();
    printResult("{} pictures in {:.1f} s: {:.1f} pictures a second, motion at {:.0f} % of real time\n", pictures_,
                seconds, static_cast<double>(pictures_) / seconds, 100.0 * moved / seconds);
}

}  // namespace taut::game
