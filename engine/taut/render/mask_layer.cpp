#include "taut/render/private/mask_layer.h"

#include <fmt/format.h>

#include <utility>

#include "taut/render/private/layer_pass.h"

namespace taut::render {
namespace {

using MaskColours = std::map<std::string, std::uint32_t>;

class MaskPass : public FlatPass {
  public:
    MaskPass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size, MaskColours colours)
        : FlatPass(gl, shaders.program("mask.vert", "mask.frag"), size), colours_(std::move(colours)) {}

  private:
    void begin(Program& program, const LayerScene&, const view::Surface& surface) const override {
        const auto known = colours_.find(surface.name);
        const std::uint32_t flat = known == colours_.end() ? 0 : known->second;
        program.set("flatColour", glm::vec3(flat >> 16 & 255U, flat >> 8 & 255U, flat & 255U) / 255.0F);
    }

    MaskColours colours_;
};

class MaskLayer : public Layer {
  public:
    explicit MaskLayer(MaskColours colours) : colours_(std::move(colours)) {}

    std::string name() const override { return "mask"; }

    LayerFacts facts() const override {
        LayerFacts facts;
        // Surfaces of colliders go by their own name alone.
        for (const auto& [name, colour] : colours_)
            facts.emplace_back(name.find('.') == std::string::npos ? "collider." + name : name,
                               fmt::format("#{:06x}", colour));
        return facts;
    }

    std::unique_ptr<LayerPass> pass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size) const override {
        return std::make_unique<MaskPass>(gl, shaders, size, colours_);
    }

  private:
    MaskColours colours_;
};

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

}  // namespace

std::shared_ptr<const Layer> maskLayer(std::map<std::string, std::uint32_t> colours) {
    return std::make_shared<MaskLayer>(std::move(colours));
}

LayerKind maskKind() {
    LayerKind kind{"mask",
                   "Write a NAME.mask.png beside each frame: one flat colour per body, black elsewhere; run.json lists "
                   "the colours"};
    kind.ask = [](double, const view::FrameView& first) -> std::shared_ptr<const Layer> {
        MaskColours colours;
        for (const view::Surface& surface : first.surfaces)
            colours.try_emplace(surface.name, flatColour(static_cast<std::uint32_t>(colours.size()) + 1));
        return colours.empty() ? nullptr : maskLayer(std::move(colours));
    };
    return kind;
}

}  // namespace taut::render
