// What a scene asks of a run: accuracy, claims about the state, pictures to compare.
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
    std::optional<double> budget;       // [ms] for each frame
};

// A claim about the state, e.g. "max_strain(cloth.*) < 0.1". Without at, from and upTo it must always hold.
struct CheckSpec {
    Source source;  // of the text's first character
    std::string that;
    std::shared_ptr<const check::Check> parsed;  // set by the loader; none: whoever needs it parses the text
    std::optional<double> at;                    // [s] at this moment
    std::optional<double> from, upTo;            // [s] all through this span, ends included
};

// Pictures to compare with recorded ones.
struct GoldenSpec {
    Source source;
    std::vector<int> frames;  // numbers, from 0
    bool restart = false;     // draws the state stored with the picture instead of the computed one
    bool debug = false;       // with springs, points and contacts
    std::string camera;       // name; empty: as in [picture]
    ivec2 size{640, 360};     // [px]
};

}  // namespace taut::world
