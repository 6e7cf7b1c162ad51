// The scene of a window follows its files: read again when one of them changes.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "game/live_play.h"
#include "game/messages.h"
#include "game/scene_file.h"
#include "taut/core/error.h"
#include "taut/scene/private/used_files.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

constexpr double catchingUp = 2.0;  // [s] of wall time at most

}  // namespace

// The scene that is there goes on where the file cannot be read.
void LivePlay::reload() {
    try {
        scene::Loaded scene = readScene(changes_);
        const std::string said = follow(std::move(scene));
        screen_.showFault("");
        watchFiles(false);
        makeLevels();  // the renderer may be another, and textures have to be read again
        say(said);
    } catch (const core::Error& error) {
        watchFiles(true);
        screen_.showFault(error.what());
        hasChanged_ = true;
        printNote("{}\n", error.what());
    }
}

// With the state as it is, where the new scene leads to the same one; else none.
std::unique_ptr<live::Session> LivePlay::goingOn(const scene::Loaded& scene) const {
    const std::int64_t tick = session_->tick();
    if (session_->divergence() || scene.keys.stateAt(tick) != keys_.stateAt(tick)) return nullptr;
    try {
        return std::make_unique<live::Session>(scene.spec, settings_.threads, *session_);
    } catch (const core::Error&) {
        return nullptr;  // later actions require other steps
    }
}

// To the moment that is shown, by simulating from the start where nothing else leads there, as far as there is time.
// Returns the message about it.
std::string LivePlay::follow(scene::Loaded scene) {
    const double moment = session_->world().time();
    if (std::unique_ptr<live::Session> next = goingOn(scene)) {
        adopt(std::move(next), std::move(scene.keys));
        return fmt::format("reloaded; continues at {:.2f} s", moment);
    }
    auto session = std::make_unique<live::Session>(std::move(scene.spec), settings_.threads);
    const auto wanted = static_cast<int>(std::min(moment / session->world().tickSeconds() + 0.5, 1e9));
    session->begin(wanted, catchingUp);
    session->wait();
    const std::string kept = keptRecording();
    const double time = session->world().time();
    const bool isThere = session->tick() >= wanted;
    adopt(std::move(session), std::move(scene.keys));
    dragging_ = Dragging::nothing;
    return fmt::format("{}reloaded; simulated from the start to {:.2f} s{}{}", kept, time,
                       isThere ? "" : ", limited to 2 s", isRecording_ ? "; the recording restarts" : "");
}

// A scene that cannot be read is watched by the files that it had, by the scenes beside it, on which it may build now,
// and by their folder, where a missing file may appear.
void LivePlay::watchFiles(bool isBroken) {
    std::vector<std::string> files;
    for (const scene::UsedFile& file : scene::usedFiles(session_->spec())) files.push_back(file.path);
    if (isBroken) {
        std::filesystem::path folder = std::filesystem::path(session_->spec().file).parent_path();
        if (folder.empty()) folder = ".";
        files.push_back(folder.string());
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
            if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
    }
    files_.watch(std::move(files));
}

}  // namespace taut::game
