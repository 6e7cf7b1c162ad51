// The tables from which commands choose by name: values, to which another program can add rows.
#pragma once

#include "taut/geometry/private/format_table.h"
#include "taut/render/layer_table.h"

namespace taut::game {

struct Tables {
    geometry::Formats formats = geometry::builtInFormats();  // of geometry, chosen by the endings of file names
    render::LayerKinds layers = render::builtInLayers();     // of pictures, chosen by flags with their names
};

}  // namespace taut::game
