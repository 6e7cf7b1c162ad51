// The error and cost of every method at every step. It draws and writes nothing.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "taut/core/private/listener.h"
#include "taut/study/horizon.h"
#include "taut/study/reference.h"
#include "taut/study/subject.h"

namespace taut::study {

enum class RunStatus {
    ok,
    diverged,
    lost,  // ran to the end, but its RMS error is larger than everything it moves in
};
std::string_view nameOf(RunStatus status);

// One method at one step. Errors are of positions in metres, or of y; unset numbers are NaN.
struct RunPoint {
    static constexpr double unset = std::numeric_limits<double>::quiet_NaN();
    std::string method;
    Precision precision = Precision::double_;
    double step = 0;  // h [s]
    long long steps = 0;
    RunStatus status = RunStatus::ok;
    // Over the sample times within the horizon.
    double rmsError = unset, finalError = unset, maxError = unset;
    bool isAtFloor = false;  // of the reference's own error, of rounding or of a solver's tolerance
    // Largest |E - E_ref| over the largest kinetic energy of the reference: of an undamped motion the drift.
    double energyError = unset;
    bool isEnergyAtFloor = false;
    // Beyond the horizon: differences of means over its sample times.
    double meanEnergyError = unset;  // relative, as energyError
    double extentError = unset;      // [m]
    double heightError = unset;      // [m]
    // Cost of the whole run without looking at it.
    std::int64_t evaluations = 0, iterations = 0, unconverged = 0;
    double seconds = unset;                           // median of the repeats
    double fastSeconds = unset, slowSeconds = unset;  // between which half of the repeats lie
    int repeats = 0;
};

struct MethodFacts {
    std::string name, title;
    int order = 0;
    double stepLimit = 0;  // [s] 0: every step is unstable; infinite: none is
};

struct WorkPrecision {
    std::string name, title, unit;
    int dimensions = 1;
    bool hasEnergy = false;
    Grid grid;
    Horizon horizon;
    int window = 0;  // samples within the horizon
    Reference reference;
    double frame = 1.0 / 60;           // [s] between two pictures
    bool hasContacts = false;          // in the reference: diverging runs may touch anything
    std::vector<MethodFacts> methods;  // in the order of the table
    std::vector<RunPoint> points;      // by method, precision, falling step
    std::vector<std::string> remarks;  // notes for the reader
    bool isInterrupted = false;
};

struct StudySettings {
    std::vector<std::string> methods;  // empty: all
    std::vector<Precision> precisions = {Precision::single_, Precision::double_};
    double seconds = 0;  // [s] of motion; 0: as the subject says, at most three horizons
    double budget = 40;  // [s] of wall time to aim at
    int halvings = 0;    // of the step, exactly so many for every curve and untimed; 0: as many as the budget allows
    core::Listener listener{};
};

// Throws core::Error(usage) for a method that is not there or does not fit the subject.
WorkPrecision studyWorkPrecision(const Subject& subject, const StudySettings& settings);

// The slope of log error over log step of a method's curve, over its last three points above its floor: thirty times
// above the least error if points are at the floor, and above rounding by a unit a step. NaN with fewer than three such
// points below 3 % of the motion's size.
double measuredOrder(const WorkPrecision& study, std::string_view method, Precision precision);

}  // namespace taut::study
