#include "game/layer_flags.h"

#include <bit>
#include <filesystem>
#include <utility>

#include "game/flags.h"
#include "game/usage.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/private/video_writer.h"
#include "taut/spec/spec.h"
#include "taut/world/world.h"

namespace taut::game {

void addLayerFlags(Options& options, LayerFlags& flags, const Option& debug) {
    options
        .flag("--alpha", flags.alpha,
              "Transparent background, with shadows as alpha: frames, .webm (VP9) or .mov (ProRes 4444)")
        .excludes(debug);
    for (LayerFlag& layer : flags.layers) {
        options.flag("--" + layer.kind.name, layer.isGiven, layer.kind.help);
        if (const auto& number = layer.kind.number)
            options.value("--" + number->name, layer.number, number->help)
                .typeName(number->unit)
                .check(numberWithin(number->least, number->most));
    }
    options
        .value("--motion-blur", flags.blurMoments,
               "Number of moments averaged in each picture while the shutter is open, half of the frame time")
        .typeName("N")
        .within(2, 256);
    options
        .value("--f-stop", flags.fStop,
               "Depth of field: the f-number of the lens, with film 24 mm high; averages 32 pictures")
        .typeName("N")
        .check(numberWithin(1e-3, 1e3));
    options.value("--focus", flags.focus, "Distance of sharp focus for --f-stop; default the camera's target")
        .typeName("METRES")
        .check(numberWithin(1e-3, 1e6));
}

std::vector<LayerFlag> flagsOf(const render::LayerKinds& kinds) {
    return {kinds.all().begin(), kinds.all().end()};
}

void checkLayerFlags(const LayerFlags& flags, const std::string& output, const std::string& video) {
    for (const std::string& name : {output, video})
        if (flags.alpha && image::isVideoPath(name) && !image::mayHaveAlpha(name))
            failUsage("--alpha: a {} has no transparency: write {}.webm, {}.mov, or frames, -o out/frame_######.png",
                      std::filesystem::path(name).extension().string(),
                      std::filesystem::path(name).replace_extension().string(),
                      std::filesystem::path(name).replace_extension().string());
    for (const LayerFlag& layer : flags.layers)
        if (layer.hasOwnNumber() && !layer.isGiven)
            failUsage("--{} sets the numbers of --{}: add both", layer.kind.number->name, layer.kind.name);
    if (flags.focus > 0.0 && flags.fStop == 0.0) failUsage("--focus sets the distance for --f-stop: add --f-stop");
    const std::vector<std::string> besides = filesBeside(flags);
    if (!besides.empty() && (output.empty() || image::isVideoPath(output)))
        failUsage("--{} writes files beside frames: add -o out/frame_######.png; --video adds a video",
                  besides.front());
}

std::vector<std::uint64_t> lookOf(bool debug, bool overlay, const LayerFlags& flags) {
    const auto bit = [](bool is) { return std::uint64_t{is ? 1U : 0U}; };
    std::vector<std::uint64_t> look{bit(debug), bit(overlay)};
    if (flags.alpha || !filesBeside(flags).empty()) {
        look.push_back(bit(flags.alpha));
        for (const LayerFlag& layer : flags.layers) look.push_back(bit(layer.isGiven));
        for (const LayerFlag& layer : flags.layers)
            if (layer.kind.number) look.push_back(layer.isGiven ? std::bit_cast<std::uint64_t>(layer.number) : 0);
    }
    if (flags.blurMoments > 0) look.push_back(static_cast<std::uint64_t>(flags.blurMoments) << 32U);
    if (flags.fStop > 0.0)
        look.insert(look.end(), {std::bit_cast<std::uint64_t>(flags.fStop), std::bit_cast<std::uint64_t>(flags.focus)});
    return look;
}

void expose(const LayerFlags& flags, const world::SceneSpec& spec, int threads, pipeline::RunOptions& options) {
    options.blurMoments = flags.blurMoments;
    options.fStop = flags.fStop;
    options.focus = flags.focus;
    for (const LayerFlag& layer : flags.layers)
        if (layer.isGiven && layer.kind.needsNext)
            options.ahead = pipeline::frameAhead([spec, threads] { return world::World(spec, {.threads = threads}); });
}

std::vector<std::string> filesBeside(const LayerFlags& flags) {
    std::vector<std::string> kinds;
    for (const LayerFlag& layer : flags.layers)
        if (layer.isGiven) kinds.push_back(layer.kind.name);
    return kinds;
}

pipeline::PictureLayers layersOf(const LayerFlags& flags, const world::World& world) {
    pipeline::PictureLayers layers{flags.alpha};
    for (const LayerFlag& layer : flags.layers) {
        layers.kinds.push_back(layer.kind.name);
        if (!layer.isGiven) continue;
        if (auto asked = layer.kind.ask(layer.number, world.view(false))) layers.layers.push_back(std::move(asked));
    }
    return layers;
}

}  // namespace taut::game
