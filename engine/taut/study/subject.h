// The subject of a study: a problem that any method can integrate from the same start, sampled at fixed times.
// Independent of measurements and charts.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/ode/method.h"
#include "taut/spec/solver_spec.h"

namespace taut::study {

using world::Precision;

std::string_view nameOf(Precision precision);  // "single", "double"

// The times at which a run is looked at: spacing, 2 spacing, …, samples · spacing. Every step length hits them exactly.
struct Grid {
    double spacing = 1;  // [s]
    int samples = 10;
    double duration() const { return spacing * samples; }
};

// One run: which method, at which step, from which start.
struct RunPlan {
    std::string method;
    Precision precision = Precision::double_;
    Grid grid;
    long long stepsPerSample = 1;
    double tolerance = 0;     // [unit/s] of a method that controls its error; of the others 0
    double solverShare = 1;   // of the usual tolerance of an implicit method's solves
    double perturbation = 0;  // [m] largest shift of each coordinate of the start; repeats exactly
    double step() const { return grid.spacing / static_cast<double>(stepsPerSample); }  // [s]
    long long steps() const { return stepsPerSample * grid.samples; }
};

// The state at a sample time.
struct Observation {
    std::vector<double> values;  // (points × dimensions) positions of the free points [m], or y
    double energy = std::numeric_limits<double>::quiet_NaN();   // [J], velocities synchronised
    double kinetic = std::numeric_limits<double>::quiet_NaN();  // [J]
    bool hasTouched = false;                                    // anything, at any moment so far
};

// A run in progress. The time that advance() takes is the method's own: nothing is looked at there.
class Trial {
  public:
    virtual ~Trial() = default;
    // To the next sample time; false when the state has diverged, soon after it has.
    virtual bool advance() = 0;
    virtual Observation observe() = 0;
    virtual ode::Work work() const = 0;
};

// Whether a coordinate can belong to a state that has not diverged.
inline bool isBounded(double value) {
    return value < 1e9 && value > -1e9;  // written so that NaN fails
}

class Subject {
  public:
    virtual ~Subject() = default;

    virtual const std::string& name() const = 0;   // "cloth-corners"
    virtual const std::string& title() const = 0;  // "Hanging cloth, 16 × 16 cells, two corners held"
    virtual int dimensions() const = 0;            // numbers a point
    virtual std::string unit() const = 0;          // of the values: "m", or empty
    virtual bool hasEnergy() const = 0;
    virtual double duration() const = 0;  // [s] to be studied unless the user says otherwise

    virtual bool accepts(const ode::MethodInfo& method) const = 0;

    // Times for a study of `duration` of which the first `window` should have ten samples.
    virtual Grid grid(double duration, double window) const = 0;
    // Steps a sample are a multiple of this.
    virtual long long quantum(const Grid& grid) const;

    virtual std::unique_ptr<Trial> begin(const RunPlan& plan) const = 0;

    // The largest stable step [s] as the method's own bound has it: 0 for none, infinite without limit.
    virtual double stepLimit(const ode::MethodInfo& method) const = 0;

    // The theory at a time; none: a reference has to be computed.
    virtual std::optional<Observation> exact(double t) const;

    // [s] between two pictures: the scale for the time of a run.
    virtual double frame() const { return 1.0 / 60; }

    // Causes of a lower measurable order, in words; empty: none.
    virtual std::string caution() const { return ""; }
};

// The methods of these names, or all, in the order of the table.
std::vector<ode::MethodInfo> chosenMethods(const std::vector<std::string>& names);

// Steps a sample with which the step is at most `step` [s].
long long stepsPerSample(const Subject& subject, const Grid& grid, double step);

}  // namespace taut::study
