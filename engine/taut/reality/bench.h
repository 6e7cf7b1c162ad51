// The common part of the rows of the reality study: kept scenes, timed plays, lines of the table.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "taut/reality/comparison.h"
#include "taut/world/world.h"

namespace taut::reality {

inline constexpr double g = 9.81;  // [m/s²]

// A straight rope held at its start, unless `more` overrides it.
struct LineScene {
    int cells = 0;
    double length = 0.1;           // [m]
    double weight = 0.02 * g;      // [N] of the whole under 9.81 m/s²
    double rigidity = 0;           // EI [N m²]; 0: none
    double stretch = 5e3;          // EA [N]
    double drag = 0, damping = 0;  // [1/s], [s]
    std::string place;             // `ends = …` and how it is held, lines of [rope.strip]
    std::string method = "implicit-euler";
    double fps = 60, seconds = 5;
    double gravity = g;  // downwards [m/s²]
    std::string more;    // further tables
};
std::string lineScene(const LineScene& scene);
// The ends and places of a rope that runs as `way` says at each length of so many from its start [m].
std::string laidAlong(double length, int parts, const std::function<glm::dvec3(double)>& way);

class Bench {
  public:
    Bench(const Settings& settings, Comparison& study) : settings_(settings), study_(study) {}
    void begin(const std::string& row) { row_ = row, processor_ = simulated_ = 0; }

    const Settings& settings() const { return settings_; }
    int cells(int own) const { return settings_.cells > 0 ? settings_.cells : own; }

    // Keeps the scene under the name and loads it.
    world::World load(const std::string& name, const std::string& scene);
    // Plays so many seconds, and looks after every tick. Throws core::Error(diverged), or (interrupted).
    void play(world::World& world, double seconds, const std::function<void()>& look = {});
    // Plays until every point of the target is slower than 1e-5 of the length a second, at most a minute; whether it
    // came to that.
    bool settle(world::World& world, const std::string& target, double length);

    // Adds a line with the cost of all plays since the line before. `missing`: why there is no value; empty: there is.
    void line(const std::string& quantity, const std::string& source, double expected, double value, double tolerance,
              int cells, const std::string& missing = "");
    // The same for a value at rest.
    void restingLine(bool isAtRest, const std::string& quantity, const std::string& source, double expected,
                     double value, double tolerance, int cells) {
        line(quantity, source, expected, value, tolerance, cells, isAtRest ? "" : "does not come to rest");
    }

    // Where between low and high `gives` turns true, halved so often; looks at the ends first. Not a number, if it is
    // true at low or false at high.
    static double threshold(double low, double high, int halvings, const std::function<bool(double)>& gives);

    std::vector<DroopCurve>& droops() { return study_.droops; }
    std::vector<DrapeBand>& drapes() { return study_.drapes; }

  private:
    const Settings& settings_;
    Comparison& study_;
    std::string row_, scene_;
    double processor_ = 0, simulated_ = 0;  // since the last line [s]
};

// The frequencies [rad/s] nearest to the guesses, within an eighth, at which samples `dt` apart have most of their
// power (Fourier sum under Blackman's window).
std::vector<double> frequenciesNear(const std::vector<double>& samples, double dt, const std::vector<double>& guesses);

}  // namespace taut::reality
