// Draws the floor, with shadows only where they can fall, and the sky. Visible parts that do not change under a still
// camera are drawn once and kept.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/render/private/frame_block.h"
#include "taut/render/private/ground.h"
#include "taut/render/private/light_maps.h"
#include "taut/render/private/program.h"
#include "taut/render/private/targets.h"
#include "taut/render/private/texture_cache.h"
#include "taut/render/renderer.h"

namespace taut::render {

class GroundPass {
  public:
    // Of the options it takes `alpha`, `keepsStill` and `plainByGl`.
    GroundPass(const Gl& gl, const ShaderFolder& shaders, TextureBudget& budget, const RendererOptions& options);

    // Call before anything else of a picture is drawn, with the frame block and the maps in place. `block` has the
    // common inputs of all shaders.
    void begin(const view::FrameView& view, const FrameBlock& block, const LightSet& lights,
               std::span<const DrawItem> items, const std::optional<OcclusionArea>& occlusion, const LightMaps& maps,
               Targets& targets);

    // Draws behind the content of the bound target, with the frame block and the maps in place. Leaves out the pixels
    // of fill().
    void draw(const glm::mat4& projection);

    // Puts the kept pixels, or those of plain ground and sky, where nothing has been drawn, and in front of things
    // behind them. `depths` are those of the part in which there are things, `colours` those of the picture; rows from
    // below.
    void fill(const PixelBox& part, std::span<float> depths, std::span<std::uint32_t> colours, int width) const;

    bool fills() const { return isKept_ || isPlain_; }
    bool isPlain() const { return isPlain_; }  // then fillGround() colours the rest

    void forget();  // the kept pixels

  private:
    // All that ground and sky in the open depend on.
    struct Still {
        FrameBlock block{};
        std::optional<float> groundHeight;
        std::optional<view::Finish> pattern;
        std::optional<view::Environment> environment;
        bool operator==(const Still& other) const;
    };
    // The inputs of the ground, besides its being shaded by still things only.
    struct StillShade {
        FrameBlock block{};
        std::vector<ShadowShape> shapes;
        bool operator==(const StillShade& other) const;
    };
    // The kept look of a cell.
    enum class Look : std::uint8_t { open, darkened, shaded };

    // The ground with a pattern under lights of a kind, and the sky.
    struct Grounds {
        Program shaded, darkened, open, background;
    };

    Grounds& groundsUnder(const LightKind& kind, view::Pattern pattern = view::Pattern::plain);
    void keep(const glm::mat4& projection, Targets& targets);
    void leaveOut(std::vector<std::uint32_t>& triangles, Look look) const;
    void drawCells(Program& program, const std::vector<std::uint32_t>& triangles);
    void drawOpen(const glm::mat4& projection, const std::vector<std::uint32_t>& triangles);

    const Gl* gl_;
    bool keepsStill_, isTransparent_, plainByGl_;
    const ShaderFolder* shaders_;
    TextureCache textures_;
    std::map<std::pair<LightKind, view::Pattern>, Grounds> grounds_;
    Grounds* now_ = nullptr;  // of them
    GlObject layout_, vertices_, indices_, empty_;
    GroundMesh mesh_;
    std::optional<Still> before_;         // of the picture before
    std::optional<StillShade> shadeNow_;  // of this one
    std::optional<StillShade> keptShade_;
    int shadeStays_ = 0;                      // pictures for which it has been the same
    bool isPlain_ = false;                    // without pattern, and with nothing but a sky around
    bool isKept_ = false;                     // the following belongs to the same camera
    std::vector<Look> looks_;                 // (positions) of the cells whose triangles begin there
    std::vector<std::uint32_t> keptColours_;  // (pixels) rows from below
    std::vector<float> keptDepths_;           // (pixels) 1 where the sky is
};

}  // namespace taut::render
