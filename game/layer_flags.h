// The flags of what a picture has besides colours, and of its exposure: alpha, depth, a mask of bodies, motion blur. It
// draws nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/pipeline/run.h"
#include "taut/pipeline/run_record.h"

namespace taut::world {
class World;
}

namespace taut::game {

struct LayerFlags {
    bool alpha = false, depth = false, mask = false;
    int blurMoments = 0;              // 0: no motion blur
    double fStop = 0.0, focus = 0.0;  // as of pipeline::RunOptions
    double depthRange = 65.534;       // [m] that a depth of 65534 stands for: a millimetre a step
};

// `debug` is the flag of the debug view, which is not transparent.
void addLayerFlags(Options& options, LayerFlags& flags, const Option& debug);

// Throws core::Error(usage) where an output cannot hold what is asked for. `output` and `video` are as on the command
// line, empty where there is none.
void checkLayerFlags(const LayerFlags& flags, const std::string& output, const std::string& video);

// The exposure, into the options of a run.
void expose(const LayerFlags& flags, pipeline::RunOptions& options);

// What pictures depend on besides the scene; `debug` and `overlay` are flags of their own.
std::vector<std::uint64_t> lookOf(bool debug, bool overlay, const LayerFlags& flags);

// Kinds of files beside frames: image::FramePattern::beside.
std::vector<std::string> filesBeside(const LayerFlags& flags);

// What says in files of depths what their numbers are.
std::string depthComment(const LayerFlags& flags);

// What the renderer has to know; in the mask every surface of the world has a colour by its name.
pipeline::PictureLayers layersOf(const LayerFlags& flags, const world::World& world);

}  // namespace taut::game
