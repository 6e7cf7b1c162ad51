// The flags of layers and exposure of a picture: alpha, layers, motion blur. It draws nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/command_line.h"
#include "taut/pipeline/run.h"
#include "taut/pipeline/run_record.h"
#include "taut/render/layer_table.h"

namespace taut::world {
struct SceneSpec;
class World;
}  // namespace taut::world

namespace taut::game {

// A row of the table of layers, with its values on the command line.
struct LayerFlag {
    render::LayerKind kind;
    bool isGiven = false;
    double number = 0.0;  // the number of the row; its default if not given

    explicit LayerFlag(const render::LayerKind& row) : kind(row), number(row.number ? row.number->standard : 0.0) {}
    bool hasOwnNumber() const { return kind.number && number != kind.number->standard; }
};

struct LayerFlags {
    bool alpha = false;
    std::vector<LayerFlag> layers{};  // one for each row
    int blurMoments = 0;              // 0: no motion blur
    double fStop = 0.0, focus = 0.0;  // as in pipeline::RunOptions
};

// `debug` is the flag of the debug view, which is not transparent. Expects that the rows exist and outlive the options.
void addLayerFlags(Options& options, LayerFlags& flags, const Option& debug);

std::vector<LayerFlag> flagsOf(const render::LayerKinds& kinds);

// Throws core::Error(usage) if an output cannot hold the requested layers. `output` and `video` are as on the command
// line, or empty.
void checkLayerFlags(const LayerFlags& flags, const std::string& output, const std::string& video);

// Writes the exposure into the options of a run, and the next frame if a layer needs it, by worlds of the scene.
void expose(const LayerFlags& flags, const world::SceneSpec& spec, int threads, pipeline::RunOptions& options);

// Flags that change pictures besides the scene. `debug` and `overlay` are separate flags.
std::vector<std::uint64_t> lookOf(bool debug, bool overlay, const LayerFlags& flags);

// Kinds of files beside frames: image::FramePattern::beside.
std::vector<std::string> filesBeside(const LayerFlags& flags);

// The options for the renderer. `world` is the first to be shown.
pipeline::PictureLayers layersOf(const LayerFlags& flags, const world::World& world);

}  // namespace taut::game
