// The record of a run as text: run.json and metrics.csv. It knows neither where they go nor how the run was started.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/pipeline/machine.h"
#include "taut/pipeline/run.h"
#include "taut/render/renderer.h"

namespace taut::world {
struct SceneSpec;
class World;
}  // namespace taut::world

namespace taut::pipeline {

// The layers of pictures besides colours.
struct PictureLayers {
    bool alpha = false;
    std::vector<std::string> kinds{};  // names of all possible layers
    std::vector<std::shared_ptr<const render::Layer>> layers{};
};

// The settings of the user, besides the scene itself.
struct RunRequest {
    std::string output;                  // as given on the command line; empty: none
    std::vector<std::string> overrides;  // "key=value"
    int threads = 0;                     // 0: all of the machine
    RunOptions options;
    PictureLayers layers{};
    std::uint64_t key = 0;                  // of the whole run, of which this may be a part
    std::int64_t firstFrame = 0;            // as asked for; if a run goes on, its options begin later
    std::int64_t frames = 1;                // of the whole run
    bool isBegun = false;                   // nothing of it has been done yet
    std::vector<std::uint32_t> pictures{};  // checksums of the files of frames firstFrame, …
};

// Receives the text piece by piece.
using Write = std::function<void(std::string_view)>;

// Writes the inputs, the settings and the machine of a run; state hashes have 16 hexadecimal digits.
void writeRunJson(const Write& write, const world::SceneSpec& spec, const world::World& world,
                  const RunRequest& request, const Machine& machine,
                  const std::optional<render::RendererInfo>& renderer, const RunResult& result);

// Writes one line for each frame that has metrics, and a heading with the units; then the figures under their names, to
// 17 digits. Cells are empty if a figure was not measured or is no number. Cells about contact are empty if no body of
// the scene has contact.
void writeMetricsCsv(const Write& write, const world::SceneSpec& spec, const RunResult& result,
                     const std::vector<std::string>& figures = {});

}  // namespace taut::pipeline
