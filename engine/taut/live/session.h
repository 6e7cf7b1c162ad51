// Plays a world: ticks run on their own thread while the last picture is drawn. It has the hand that grabs, and keeps
// all that the hand did since the start. It knows neither windows nor GL.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/island/report.h"
#include "taut/live/mouse_hand.h"
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
    // A session at the time of `from`, with its hand and its past actions, of a scene that leads there too. Throws
    // core::Error(badContent) if that state does not fit it.
    Session(world::SceneSpec spec, int threads, const Session& from);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    // Begins that many ticks and returns at once. Fewer are done if they would take longer than `budget` [s] of wall
    // time, but at least one if any was asked for. Nothing else may be called until wait().
    void begin(int ticks, double budget);
    // Waits until the ticks are done.
    void wait();

    const world::World& world() const;
    const world::SceneSpec& spec() const { return spec_; }
    std::int64_t tick() const;
    const world::Metrics& metrics() const;  // of this tick

    // The views of the last two ticks; after a start the same one twice.
    const view::FrameView& before() const;
    const view::FrameView& now() const;
    void showMarks(bool shown);  // springs coloured by strain, points and contacts

    MouseHand& hand();
    const world::Specs<world::ActionSpec>& deeds() const;  // of the hand since the start
    // The points that may be grabbed, at their present places: free points only, unless `withHeld`.
    std::vector<BodyPoints> bodies(bool withHeld = false) const;
    // [N] largest force of a hand in a window on this body, so that it slips from heavy bodies instead of stretching
    // them: `weights` times the weight on earth of the free points of all connected bodies.
    static constexpr double weights = 2.0;
    double handForce(const std::string& body) const;
    // The hand takes a point, as that of a window: with the scene's springs, with nearby points, and with that force.
    void grab(const PickedPoint& point);

    // An action at the start of the next tick, before the hand's, which is kept as one of its deeds. It has to begin at
    // nextTime() [s].
    void apply(const world::ActionSpec& action);
    double nextTime() const;

    // After a divergence, why nothing moves any more.
    const std::optional<world::Divergence>& divergence() const;
    // The action errors since the last call.
    std::vector<std::string> takeFaults();

    // Advances to the next frame and returns the actions since the start. It plays at least one tick if the hand acted
    // after the last tick. The caller sets `scene` and `overrides`. Do not call it after a divergence.
    Recording record();

  private:
    struct Impl;
    world::SceneSpec spec_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace taut::live
