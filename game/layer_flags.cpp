#include "game/layer_flags.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

#include "game/flags.h"
#include "taut/core/error.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/video_writer.h"
#include "taut/world/world.h"

namespace taut::game {
namespace {

// Bits of the number go to the channels in turn, the lowest to what is seen best: numbers that follow each other look
// different, and no two are the same.
std::uint32_t flatColour(std::uint32_t number) {
    std::uint32_t red = 0, green = 0, blue = 0;
    for (std::uint32_t bit = 0; bit < 8; ++bit, number >>= 3) {
        red |= (number & 1U) << (7 - bit);
        green |= (number >> 1 & 1U) << (7 - bit);
        blue |= (number >> 2 & 1U) << (7 - bit);
    }
    return red << 16 | green << 8 | blue;
}

double unitOf(const LayerFlags& flags) {
    return flags.depthRange / (image::farDepth - 1);
}

}  // namespace

void addLayerFlags(Options& options, LayerFlags& flags, const Option& debug) {
    options
        .flag("--alpha", flags.alpha,
              "A transparent background, with shadows as alpha: frames, .webm (VP9) or .mov (ProRes 4444)")
        .excludes(debug);
    options.flag("--depth", flags.depth,
                 "Beside each frame a 16-bit grey NAME.depth.png: 0-65534 is 0 to --depth-range ahead of the camera "
                 "along its axis, 1 mm a step if not given; 65535 is the background");
    options.value("--depth-range", flags.depthRange, "What 65534 stands for in --depth [m]; farther counts as that")
        .typeName("METRES")
        .check(numberWithin(1e-3, 1e6));
    options
        .value("--motion-blur", flags.blurMoments,
               "Moments drawn of each picture while the shutter is open, half the time from one to the next")
        .typeName("N")
        .within(2, 256);
    options
        .value("--f-stop", flags.fStop,
               "Depth of field: the f-number of the lens, with film 24 mm high; each picture is drawn 32 times")
        .typeName("N")
        .check(numberWithin(1e-3, 1e3));
    options
        .value("--focus", flags.focus, "How far ahead things are sharp with --f-stop; the camera's target if not given")
        .typeName("METRES")
        .check(numberWithin(1e-3, 1e6));
    options.flag("--mask", flags.mask,
                 "Beside each frame a NAME.mask.png: one flat colour a body, black where none is; run.json says which");
}

void checkLayerFlags(const LayerFlags& flags, const std::string& output, const std::string& video) {
    const auto fail = [](const std::string& message) { throw core::Error(core::ErrorKind::usage, message); };
    for (const std::string& name : {output, video})
        if (flags.alpha && image::isVideoPath(name) && !image::mayHaveAlpha(name))
            fail(
                fmt::format("--alpha: a {} has no transparency: write {}.webm, {}.mov, or frames, "
                            "-o out/frame_######.png",
                            std::filesystem::path(name).extension().string(),
                            std::filesystem::path(name).replace_extension().string(),
                            std::filesystem::path(name).replace_extension().string()));
    if (flags.depthRange != LayerFlags{}.depthRange && !flags.depth)
        fail("--depth-range says what the numbers of --depth are: give that too");
    if (flags.focus > 0.0 && flags.fStop == 0.0) fail("--focus says where --f-stop is sharp: give that too");
    if ((flags.depth || flags.mask) && (output.empty() || image::isVideoPath(output)))
        fail(
            fmt::format("{} writes files beside frames: ask for those, -o out/frame_######.png; a video besides with "
                        "--video",
                        flags.depth ? "--depth" : "--mask"));
}

std::vector<std::uint64_t> lookOf(bool debug, bool overlay, const LayerFlags& flags) {
    const auto bit = [](bool is) { return std::uint64_t{is ? 1U : 0U}; };
    std::vector<std::uint64_t> look{bit(debug), bit(overlay)};
    if (flags.alpha || flags.depth || flags.mask)
        look.insert(look.end(), {bit(flags.alpha), bit(flags.depth), bit(flags.mask),
                                 flags.depth ? std::bit_cast<std::uint64_t>(flags.depthRange) : 0});
    if (flags.blurMoments > 0) look.push_back(static_cast<std::uint64_t>(flags.blurMoments) << 32U);
    if (flags.fStop > 0.0)
        look.insert(look.end(), {std::bit_cast<std::uint64_t>(flags.fStop), std::bit_cast<std::uint64_t>(flags.focus)});
    return look;
}

void expose(const LayerFlags& flags, pipeline::RunOptions& options) {
    options.blurMoments = flags.blurMoments;
    options.fStop = flags.fStop;
    options.focus = flags.focus;
}

std::vector<std::string> filesBeside(const LayerFlags& flags) {
    std::vector<std::string> kinds;
    if (flags.depth) kinds.emplace_back("depth");
    if (flags.mask) kinds.emplace_back("mask");
    return kinds;
}

std::string depthComment(const LayerFlags& flags) {
    return fmt::format(
        "depth ahead of the camera along its axis; metres per unit: {:.9g}; range: 0 to {:.9g} m; "
        "65535: background",
        unitOf(flags), flags.depthRange);
}

pipeline::PictureLayers layersOf(const LayerFlags& flags, const world::World& world) {
    pipeline::PictureLayers layers{flags.alpha, flags.depth ? unitOf(flags) : 0.0};
    if (!flags.mask) return layers;
    for (const view::Surface& surface : world.view(false).surfaces)
        layers.maskColours.try_emplace(surface.name,
                                       flatColour(static_cast<std::uint32_t>(layers.maskColours.size()) + 1));
    return layers;
}

}  // namespace taut::game
