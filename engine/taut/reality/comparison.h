// The engine held against theory and measurement, row by row: a strip's droop, its buckling, its frequencies, friction.
// It plays scenes as `taut render` would, and knows no picture.
#pragma once

#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/reality/peers.h"

namespace taut::reality {

class Bench;

// A known quantity, and the result of the engine.
struct Line {
    std::string row;       // "R1"
    std::string quantity;  // "H/W at Γ = 10, warp"
    std::string source;    // of `expected`: "heavy elastica"
    double expected = 0, value = 0;
    double tolerance = 0;  // of the error
    int cells = 0;         // along the length
    double processor = 0;  // [s] of processor time
    double simulated = 0;  // [s]
    std::string scene;     // that was played last, a key of Comparison::scenes; empty: none
    std::string missing;   // why there is no value; empty: there is

    double error() const { return value / expected - 1; }
    bool passes() const { return missing.empty() && std::abs(error()) <= tolerance; }
};

struct Row {
    std::string name, title;
    bool isLong;  // minutes instead of seconds
    void (*hold)(Bench&);
};
std::span<const Row> rows();

// Height over width of heavy cantilevers, as a chart has them.
struct DroopCurve {
    std::string name;                               // "elastica", "10 cells", …
    bool isOfSprings = false;                       // bending by springs across two cells
    int cells = 0;                                  // 0: theory
    std::vector<std::pair<double, double>> points;  // Γ, H/W
};

// The drape coefficient of a fabric that is dropped so many times.
struct DrapeBand {
    std::string fabric, colour;
    double measured = 0;
    double weight = 0;  // [kg/m²]
    int drops = 0;
    double mean = 0, spread = 0;  // standard deviation
    double folds = 0;             // mean
};

struct Comparison {
    std::vector<Line> lines;
    std::vector<std::pair<std::string, std::string>> scenes;  // name and text, in the order of playing
    std::vector<DroopCurve> droops;                           // with settings.draws
    std::vector<PeerDroop> peers;                             // results of other programs, may be empty
    std::vector<DrapeBand> drapes;                            // further weights with settings.draws
    bool isInterrupted = false;

    bool passes() const;
};

struct Settings {
    std::vector<std::string> rows;                      // none: all
    bool isLong = false;                                // adds the expensive rows; rows in `rows` are always played
    int cells = 0;                                      // along the length instead of each row's own; 0: those
    bool draws = true;                                  // plays further scenes for the chart
    std::vector<std::filesystem::path> assetFolders{};  // with models
    core::Listener listener{};
};

Comparison compare(const Settings& settings = {});

}  // namespace taut::reality
