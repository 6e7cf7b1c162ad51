// The command line of `taut render` as plain values. It renders nothing.
#pragma once

#include <string>
#include <vector>

#include "game/command_line.h"
#include "game/continuation.h"
#include "game/layer_flags.h"
#include "game/outputs.h"
#include "taut/image/frame_sequence.h"

namespace taut::game {

struct RenderFlags {
    std::string scene;
    std::string output, video;
    std::string state;  // file for the state of the last frame; empty: it is not kept
    std::string frames, shard, size, camera, gl, hashEvery = "frame", metricsOf;
    double fps = 0.0, seconds = 0.0;
    int threads = 0, samples = 0, smooth = -1;  // smooth: -1: not given
    std::vector<std::string> at;                // [s] draws stills at these moments instead of a run
    std::vector<std::string> overrides;
    ContinuationFlags continuation;
    LayerFlags layers;
    OverwriteFlags overwrite;
    bool debug = false, metrics = false, quiet = false, hash = false, noPictures = false;
    bool overlay = false, isConfined = false;
    bool writesMetrics() const { return metrics || !metricsOf.empty(); }
};

void addRenderFlags(Options& options, RenderFlags& flags);

// Gives the output a name if it has none.
void completeFlags(RenderFlags& flags);

// Throws core::Error(usage) for flags that do not go together.
void checkFlags(const RenderFlags& flags);

// The files of the pictures, by the number of the frame, or of the moment of --at. Throws core::Error(usage) if their
// names have no place for a number and there may be several.
image::FramePattern framePattern(const RenderFlags& flags);

// The flags --fps, --seconds, --size and --camera in the words of the scene format.
std::vector<std::string> allOverrides(const RenderFlags& flags);

}  // namespace taut::game
