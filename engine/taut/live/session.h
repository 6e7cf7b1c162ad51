// A world that is played: ticks on a thread of their own while the last picture is drawn, a hand that grabs, and all
// that it did since the start. It knows neither windows nor GL.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/island/report.h"
#include "taut/live/hand.h"
#include "taut/live/picking.h"
#include "taut/live/recording.h"
#include "taut/spec/spec.h"
#include "taut/view/frame_view.h"

namespace taut::world {
class World;
}

namespace taut::live {

class Session {
  public:
    // Builds the world, with hands allowed anywhere. Throws core::Error(badContent).
    Session(world::SceneSpec spec, int threads);
    // The same at the moment where `from` is, with what its hand does and has done: of a scene that leads there too.
    // Throws core::Error(badContent) where that state does not fit it.
    Session(world::SceneSpec spec, int threads, const Session& from);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Begins that many ticks and returns at once; fewer are done when they would take longer than `budget` [s] of wall
    // time, but at least one, if any. Nothing else may be called until wait().
    void begin(int ticks, double budget);
    // Until what was begun is done.
    void wait();

    const world::World& world() const;
    const world::SceneSpec& spec() const { return spec_; }
    std::int64_t tick() const;
    const world::Metrics& metrics() const;  // of this tick

    // The last two ticks, the same one twice after a start.
    const view::FrameView& before() const;
    const view::FrameView& now() const;
    void showMarks(bool shown);  // springs coloured by strain, points and contacts

    Hand& hand();
    const world::Specs<world::ActionSpec>& deeds() const;  // of the hand since the start
    // What may be grabbed, where it is now: free points only, unless `withHeld`.
    std::vector<BodyPoints> bodies(bool withHeld = false) const;
    // [N] that a hand in a window pulls this body with at most, so that it slips from what it cannot move instead of
    // stretching it: `weights` times the weight on earth of the free points of all that hangs together with it.
    static constexpr double weights = 2.0;
    double handForce(const std::string& body) const;

    // Why nothing moves any more, once it diverged.
    const std::optional<world::Divergence>& divergence() const;
    // What went wrong with an action since the last call.
    std::vector<std::string> takeFaults();

    // Goes on to the next frame, and by a tick at least if the hand did something that no tick has followed yet, and
    // tells what happened since the start. `scene` and `overrides` are left to the caller. Not once it diverged.
    Recording record();

  private:
    struct Impl;
    world::SceneSpec spec_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::live
