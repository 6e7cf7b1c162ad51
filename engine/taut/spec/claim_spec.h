// What is asked of a run: how accurate it must be, claims about the state, pictures to compare.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/spec/source.h"

namespace taut::check {
class Check;
}

namespace taut::world {

struct NeedSpec {                       // what "accurate enough" means for the scene
    std::optional<double> rmsPosition;  // [m]
    std::optional<double> rmsPercent;   // [% of the bounding box]
    std::optional<double> rmsPixels;    // [px at the output size]
    std::optional<double> horizon;      // [s]
    std::optional<double> budget;       // [ms a frame]
};

// A claim about the state, e.g. "max_strain(cloth.*) < 0.1". With neither at nor from and upTo it must always hold.
struct CheckSpec {
    Source source;  // of the text's first character
    std::string that;
    std::shared_ptr<const check::Check> parsed;  // by the loader; none: whoever looks reads it
    std::optional<double> at;                    // [s] at this moment
    std::optional<double> from, upTo;            // [s] all through this span, ends included
};

// Pictures to compare with recorded ones.
struct GoldenSpec {
    Source source;
    std::vector<int> frames;  // numbers, from 0
    bool restart = false;     // drawn from the state stored with the picture instead of the one just computed
    bool debug = false;       // with springs, points and contacts
    std::string camera;       // name; empty: that of [picture]
    ivec2 size{640, 360};     // [px]
};

}  // namespace taut::world
