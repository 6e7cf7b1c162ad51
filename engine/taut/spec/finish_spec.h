// How a thing looks.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "taut/core/value.h"
#include "taut/spec/source.h"
#include "taut/view/frame_view.h"

namespace taut::world {

struct MeshData;

// How a thing looks; see view::Finish.
struct FinishSpec {
    TAUT_VALUE(FinishSpec);
    dvec3 colour{0.75, 0.72, 0.68};
    std::optional<dvec3> backColour;  // none: a paler colour
    dvec3 accent{0.95, 0.93, 0.88};
    view::Pattern pattern = view::Pattern::plain;
    double repeat = 0.25;  // [m]
    double weave = 0.0;    // 0 … 1
    view::Binding binding = view::Binding::plain;
    double thread = 0.0015;     // [m]
    double slub = 0.0;          // 0 … 1
    double fuzz = 0.0;          // 0 … 1
    double roughness = 0.7;     // 0 … 1
    double sheen = 0.0;         // 0 … 1
    double translucency = 0.2;  // 0 … 1
    double anisotropy = 0.0;    // 0 … 1
    double hem = 0.001;         // [m] thickness of a cloth at its free edges
    int smooth = 0;             // times that a cloth or a rope is drawn twice as fine
    std::string skin;           // path of a mesh that is drawn in place of a cloth or a block; empty: none
    std::shared_ptr<const MeshData> skinData;  // content of the file; null: none
    std::string texture;                       // path, resolved by the loader
};

}  // namespace taut::world
