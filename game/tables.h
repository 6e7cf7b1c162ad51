// What commands choose from by name: tables that are values, to which another program adds rows of its own.
#pragma once

#include "taut/geometry/private/format_table.h"
#include "taut/render/layer_table.h"

namespace taut::game {

struct Tables {
    geometry::Formats formats = geometry::builtInFormats();  // of geometry, chosen by how names of files end
    render::LayerKinds layers = render::builtInLayers();     // of pictures, chosen by flags of their names
};

}  // namespace taut::game
