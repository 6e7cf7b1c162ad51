// Plays one scenario from its start to its end and keeps the results: the state of every tick as hashes, the verdicts
// of its checks, and the golden pictures as this build draws them. It compares nothing.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "taut/image/image.h"
#include "taut/island/report.h"
#include "taut/regression/drawer.h"
#include "taut/regression/scenario.h"
#include "taut/regression/tape.h"
#include "taut/report/test_report.h"
#include "taut/view/frame_view.h"

namespace taut::regression {

struct PlayedPicture {
    GoldenRequest request;
    double time = 0;                    // [s]
    std::uint64_t stateHash = 0;        // of the chain at this frame
    view::FrameView view;               // the picture drawn
    image::Image picture;               // empty: not drawn, see fault
    std::vector<std::byte> savedState;  // of a restart picture, when asked for: World::save() at this frame
    std::string fault;                  // why it could not be drawn
};

struct Played {
    Tape tape;
    std::vector<report::TestCheck> checks;  // as the scenario lists them
    std::vector<PlayedPicture> pictures;
    std::optional<world::Divergence> divergence;
    std::vector<std::string> warnings;  // of the world, at its end
    std::string renderer;               // empty when nothing was drawn
    bool interrupted = false;
    double seconds = 0;  // [s] of wall time
};

struct PlayOptions {
    int threads = 0;                          // of the world; 0: as many as the machine has
    bool savesStates = false;                 // of restart pictures
    bool endsWithLastGolden = false;          // instead of playing to the end
    std::optional<std::int64_t> lastFrame{};  // at most
    // The state that a restart picture is drawn from; none: not stored, so it is drawn from the one just computed.
    std::function<std::optional<std::vector<std::byte>>(const GoldenRequest&)> storedState{};
};

// Throws core::Error(badContent) for a scene that cannot be built, noRenderer, and the exceptions of drawing.
Played playScenario(const Scenario& scenario, Drawer& drawer, const PlayOptions& options,
                    const std::atomic<bool>& stop);

}  // namespace taut::regression
