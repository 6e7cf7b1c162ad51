// The inner loop over pixels of plain ground and sky, one copy per instruction set; every copy gives the same bits.
// Plain data only.
#pragma once

#include <cstdint>

namespace taut::render {

// The inputs of shaders/ground.frag and shaders/background.frag. Colours are light, red, green, blue.
struct GroundArgs {
    float eye[3], firstWay[3], rightWay[3], upWay[3];  // as setRays() of surface_pass.h
    float height;                                      // [m]; infinite: there is no ground
    float lines, lineShade;                            // 1 / [m]; share of the colour that they take
    float fade[4];                                     // as of the frame block
    float albedo[3], direct[3], sky[3];                // direct: of all lights
    float horizon[3], top[3];
    const float* hidden;                    // (hiddenEdge²) part of the sky that things hide; null: nowhere
    int hiddenEdge;                         // [texels]
    float hiddenLow[2], hiddenScale[2];     // [m] corner of that map, 1 / extent
    float depthStart, depthAlong, depthUp;  // of the ground in the depth buffer, from pixel to pixel
    std::uint32_t nothing;                  // mark of pixels where nothing has been drawn
};

struct GroundKernels {
    // Colours `count` pixels of row y, from column x on, where nothing has been drawn, or where the ground is nearer
    // than `depths`, and enters its depth there. Null `depths`: there is only ground and sky.
    void (*fill)(const GroundArgs& args, int x, int y, int count, std::uint32_t* colours, float* depths);
};

// For the instruction set in use.
GroundKernels groundKernels();

}  // namespace taut::render
