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
#include "taut/image/private/resize.h"
#include "taut/live/between.h"
#include "taut/live/picking.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

constexpr int mostTicks = 8;               // a picture
constexpr double longestTurn = 1.0 / 30;   // [s] from picture to picture
constexpr double tickBudget = 0.031;       // [s] of that for the ticks of a picture
constexpr double leastPicture = 1.0 / 60;  // [s] no display shows more
constexpr double idlePause = 0.012;        // [s] between looks for events while nothing changes

// The software renderer leaves a core to the ticks that are computed while it draws.
int threadsThatDraw(int threads) {
    if (threads > 0) return threads;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

std::string titleOf(const std::string& scene) {
    return "taut play " + scene;
}

}  // namespace

LivePlay::LivePlay(PlaySettings settings) : settings_(std::move(settings)), screen_(fixedFontFile()) {
    rebuild({}, "");
    if (settings_.watches) watchFiles(false);
    window_ = std::make_unique<Window>(titleOf(settings_.scene), settings_.width, settings_.height);
    width_ = static_cast<int>(std::lround(settings_.width * window_->density()));
    height_ = static_cast<int>(std::lround(settings_.height * window_->density()));
    makeLevels();
    isRecording_ = settings_.records;
    screen_.say("h: help", 5.0);
}

void LivePlay::makeLevels() {
    const world::PictureSpec& scene = session_->spec().picture;
    const bool adapts = settings_.quality == "auto";
    levels_ = adapts ? drawingLevels(scene) : std::vector{levelNamed(settings_.quality, scene)};
    std::vector<double> costs;
    for (const DrawingLevel& level : levels_) costs.push_back(level.cost);
    // As fine as before; at first where most machines end up, or a level below.
    const auto first = std::ranges::find_if(levels_, [](const auto& l) { return l.name == "normal"; });
    const std::ptrdiff_t wanted = adaptation_ ? adaptation_->level() : first - levels_.begin();
    const auto begin = std::min(wanted, std::ssize(levels_) - 1);
    adaptation_.emplace(std::move(costs), static_cast<int>(begin), longestTurn);
    const DrawingLevel& level = levels_[begin];
    world::PictureSpec picture = scene;
    picture.size = {level.pixels(width_), level.pixels(height_)};
    picture.samples = level.samples;
    picture.shadowSize = level.shadowSize;
    renderer_ = makeRenderer(picture, threadsThatDraw(settings_.threads), settings_.gl);
}

scene::Loaded LivePlay::readScene(const std::vector<std::string>& changes) const {
    std::vector<std::string> overrides = settings_.overrides;
    overrides.insert(overrides.end(), changes.begin(), changes.end());
    scene::Loaded scene = readSceneWithKeys(settings_.scene, overrides);
    if (!settings_.isQuiet) notePreparation(scene.spec);
    return scene;
}

// A new world from the start; the old one stays when the scene cannot be built so.
void LivePlay::rebuild(std::vector<std::string> changes, const std::string& said) {
    std::string kept;
    try {
        scene::Loaded scene = readScene(changes);
        auto session = std::make_unique<live::Session>(std::move(scene.spec), settings_.threads);
        kept = keptRecording();
        adopt(std::move(session), std::move(scene.keys));
    } catch (const core::Error& error) {
        if (!session_) throw;
        const std::string message = error.what();
        return say("Not possible: " + message.substr(0, message.find('\n')));
    }
    changes_ = std::move(changes);
    dragging_ = Dragging::nothing;
    if (!said.empty()) say(kept + said + (isRecording_ ? "; the recording restarts" : ""));
}

// Of the recording so far, which is not to be lost.
std::string LivePlay::keptRecording() {
    return session_ && isRecording_ && session_->tick() > 0 ? savedRecording(true) + "; " : "";
}

void LivePlay::adopt(std::unique_ptr<live::Session> session, scene::StateKeys keys) {
    session_ = std::move(session);
    keys_ = std::move(keys);
    if (!settings_.isQuiet) printWarnings(session_->world().warnings());
    overlay_ = std::make_unique<pipeline::Overlay>(fontFile(), pipeline::smallestStep(session_->world()));
    overlay_->add({session_->metrics(), session_->tick()});
    pace_ = live::Pace(session_->world().tickSeconds());
    session_->showMarks(showsMarks_);
    shownCamera_ = session_->now().camera;
    hasReportedDivergence_ = false;
    printed_ = session_->deeds().size();
    steps_ = 0;
    hasChanged_ = true;
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
        if (files_.hasChanged()) reload();
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
        findName();
        const std::int64_t before = session_->tick();
        hasChanged_ = wasSaying;  // its end is to be seen
        const int due = ticksDue(wall);
        session_->begin(due, tickBudget);
        drawPicture(view, wall);
        session_->wait();
        report();
        const int done = static_cast<int>(session_->tick() - before);
        const bool isLate = done < due && !isPaused_ && !session_->divergence();
        pace_.owe(isLate ? due - done : 0);
        // As long as it would have been with all ticks.
        adapt(drawing_, secondsSince(last) * (isLate ? static_cast<double>(due) / std::max(1, done) : 1.0));
        ticks_ += done;
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

void LivePlay::drawPicture(const view::FrameView& view, double wall) {
    const auto start = Clock::now();
    image::Image picture = renderer_->draw(view);
    if (picture.width < width_ || picture.height < height_) picture = image::enlarged(picture, width_, height_);
    moveFigures(view, wall);
    const pipeline::OverlayLook look{figures_.isAtRight(), figures_.opacity(), static_cast<float>(window_->density())};
    covered_ = {};
    if (showsOverlay_) {
        const world::SolverSpec& solver = session_->spec().solver;
        const std::vector<pipeline::OverlayLine> above = {{fmt::format("{:.0f} pictures/s", rate_), solver.integrator},
                                                          {"quality", qualityText()}};
        covered_ = overlay_->paint(picture, view.time + session_->world().tickSeconds(), above, look);
    }
    screen_.paint(picture, overlay_->letters(), {marks(), hand(), named()}, look);
    window_->show(picture);
    drawing_ = std::chrono::duration<double>(Clock::now() - start).count();
    ++pictures_;
}

// Draws finer or coarser from the next picture on, as there is time.
void LivePlay::adapt(double drawing, double turn) {
    if (!adaptation_->add(drawing, turn)) return;
    const DrawingLevel& level = levels_[adaptation_->level()];
    render::RendererOptions options;
    options.width = level.pixels(width_);
    options.height = level.pixels(height_);
    options.samples = level.samples;
    options.shadowSize = level.shadowSize;
    options.occlusion = level.occlusion;
    renderer_->change(options);
    if (settings_.isVerbose) printNote("quality {}\n", level.name);
}

std::string LivePlay::qualityText() const {
    const std::string& name = levels_[adaptation_->level()].name;
    return levels_.size() > 1 ? name + " (auto)" : name;
}

// [px] in the picture, where it holds something.
std::optional<glm::vec2> LivePlay::hand() const {
    if (dragging_ != Dragging::point) return std::nullopt;
    return glm::vec2(mouse_ * glm::dvec2(width_, height_));
}

std::optional<NamedPoint> LivePlay::named() const {
    if (!named_) return std::nullopt;
    const glm::dvec2 size(width_, height_);
    const auto at = live::seenAt(camera(), named_->position, size.x / size.y);
    if (!at) return std::nullopt;
    return NamedPoint{glm::vec2(*at * size), glm::vec2(mouse_ * size), live::nameOf(*named_)};
}

void LivePlay::moveFigures(const view::FrameView& view, double wall) {
    constexpr std::size_t mostPoints = 2000;
    const glm::dvec2 size(width_, height_);
    std::vector<glm::vec2> body;
    if (dragging_ == Dragging::point) {
        for (const view::Surface& surface : view.surfaces) {
            if (surface.name != heldBody_) continue;
            const auto& positions = surface.geometry->positions;
            for (std::size_t i = 0; i < positions.size(); i += 1 + positions.size() / mostPoints)
                if (const auto at = live::seenAt(
                        view.camera, glm::vec3(surface.transform * glm::vec4(positions[i], 1.0F)), size.x / size.y))
                    body.push_back(glm::vec2(*at * size));
        }
    }
    figures_.follow(covered_, static_cast<float>(width_), hand(), body, wall);
    hasChanged_ = hasChanged_ || figures_.isFading();
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

// The findings of the last ticks.
void LivePlay::report() {
    for (const std::string& fault : session_->takeFaults()) say(fault.substr(0, fault.find('\n')));
    const auto& deeds = session_->deeds();
    for (; printed_ < deeds.size(); ++printed_)
        if (settings_.isVerbose)
            printNote("{}\n", live::actionText(deeds[printed_], deeds[printed_].t, world::builtInActions()));
    if (!session_->divergence() || hasReportedDivergence_) return;
    hasReportedDivergence_ = true;
    printNote("{}\n", session_->divergence()->message);
    screen_.say(
        fmt::format("Diverged at {:.3f} s: backspace restarts, + halves the step", session_->divergence()->time), 1e6);
}

void LivePlay::printSummary(double seconds) const {
    const double moved = static_cast<double>(ticks_) * session_->world().tickSeconds();
    printResult("{} pictures in {:.1f} s: {:.1f} pictures a second, motion at {:.0f} % of real time, quality {}\n",
                pictures_, seconds, static_cast<double>(pictures_) / seconds, 100.0 * moved / seconds, qualityText());
}

}  // namespace taut::game
