#include "taut/render/layer_table.h"

// A line a layer, in the order in which helps and records name them: the function that returns its row.
#define TAUT_LAYERS(LAYER) \
    LAYER(depthKind)       \
    LAYER(maskKind)        \
    LAYER(normalsKind)     \
    LAYER(albedoKind)      \
    LAYER(flowKind)

namespace taut::render {

#define TAUT_DECLARE(layer) LayerKind layer();
TAUT_LAYERS(TAUT_DECLARE)
#undef TAUT_DECLARE

LayerKinds builtInLayers() {
    LayerKinds all;
#define TAUT_ADD(layer) all.add(layer());
    TAUT_LAYERS(TAUT_ADD)
#undef TAUT_ADD
    return all;
}

}  // namespace taut::render
