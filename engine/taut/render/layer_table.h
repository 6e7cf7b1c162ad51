// The layers that a picture can have beside its colours, one row each: --depth writes files NAME.depth.png. To add a
// layer, write one file that draws it and has its row, and one line in layer_table.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "taut/core/table.h"
#include "taut/view/frame_view.h"

struct GladGLContext;

namespace taut::render {

using Gl = GladGLContext;
class LayerPass;
class ShaderFolder;

// Facts about a layer for the record: names and values, in that order.
using LayerFact = std::variant<double, std::int64_t, std::string, std::vector<double>>;
using LayerFacts = std::vector<std::pair<std::string, LayerFact>>;

// A layer with its settings; several renderers may draw the same one.
class Layer {
  public:
    virtual ~Layer() = default;
    virtual std::string name() const = 0;  // that of its row
    virtual LayerFacts facts() const = 0;
    // The pass that draws it in a context, for pictures of that size. Expects that the context is current.
    virtual std::unique_ptr<LayerPass> pass(const Gl& gl, const ShaderFolder& shaders, glm::ivec2 size) const = 0;
};

// A number that belongs to a layer, and its flag.
struct LayerNumber {
    std::string name;  // "depth-range"
    std::string help;
    std::string unit;  // in the help: "METRES"
    double standard = 0.0, least = 0.0, most = 0.0;
};

struct LayerKind {
    std::string name;  // "depth": its flag is --depth, its files are NAME.depth.png
    std::string help;  // of the flag
    std::optional<LayerNumber> number{};
    bool needsNext = false;  // it draws FrameView::next too
    // Makes the layer from its number, for a run whose first view is `first`; null: there is nothing to draw.
    std::function<std::shared_ptr<const Layer>(double number, const view::FrameView& first)> ask{};
};

using LayerKinds = core::Table<LayerKind>;

LayerKinds builtInLayers();

}  // namespace taut::render
