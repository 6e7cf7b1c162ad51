// Requirements of a scene on a run: accuracy, claims about the state, numbers to fit, pictures to compare.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "taut/core/value.h"
#include "taut/spec/source.h"

namespace taut::check {
class Check;
}

namespace taut::world {

struct NeedSpec {                       // required accuracy of the scene
    std::optional<double> rmsPosition;  // [m]
    std::optional<double> rmsPercent;   // [% of the bounding box]
    std::optional<double> rmsPixels;    // [px at the output size]
    std::optional<double> horizon;      // [s]
    std::optional<double> budget;       // [ms] for each frame
};

// A claim about the state, e.g. "max_strain(cloth.*) < 0.1". Without at, from and upTo it must always hold.
struct CheckSpec {
    TAUT_VALUE(CheckSpec);
    Source source;  // of the text's first character
    std::string that;
    std::shared_ptr<const check::Check> parsed;  // set by the loader; none: whoever needs it parses the text
    std::optional<double> at;                    // [s] at this moment
    std::optional<double> from, upTo;            // [s] all through this span, ends included
};

// A measurement of a quantity, such as "lowest(cloth.strip)": one value at a moment, or a curve.
struct FitTarget {
    TAUT_VALUE(FitTarget);
    struct Point {
        double time = 0;   // [s]
        double value = 0;  // in the unit of the quantity, as sigma
        double sigma = 1;  // standard deviation of the value
    };
    Source source;
    std::string that;          // an expression of the language of checks
    std::optional<double> at;  // [s]
    std::optional<double> value, sigma;
    std::string curve;          // CSV file
    std::vector<Point> points;  // set by the loader, by time
};

// Numbers of the scene to fit to the measurements.
struct FitSpec {
    TAUT_VALUE(FitSpec);
    std::vector<std::string> keys;  // dotted paths, as of --set
    std::vector<double> low, high;  // (keys)
    std::vector<double> start;      // (keys) set by the loader: their values in the scene
    std::vector<FitTarget> targets;
};

// Pictures to compare with recorded ones.
struct GoldenSpec {
    TAUT_VALUE(GoldenSpec);
    Source source;
    std::vector<int> frames;  // numbers, from 0
    bool restart = false;     // draws the state stored with the picture instead of the computed one
    bool debug = false;       // with springs, points and contacts
    std::string camera;       // name; empty: as in [picture]
    ivec2 size{640, 360};     // [px]
};

}  // namespace taut::world
