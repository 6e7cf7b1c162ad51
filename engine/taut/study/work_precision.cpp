#include "taut/study/work_precision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/core/private/stopwatch.h"
#include "taut/ode/method_table.h"
#include "taut/study/errors.h"

namespace taut::study {
namespace {

constexpr double coarse = 3e-2;  // of the motion's size: larger errors do not show a method's order

// The errors of a run, gathered sample by sample.
class Gathering {
  public:
    Gathering(const WorkPrecision& study) : study_(study) {}

    void add(int sample, const Observation& seen) {
        const Observation& wanted = study_.reference.at[sample];
        energy_ = std::max(energy_, std::abs(seen.energy - wanted.energy));
        if (sample < study_.window) {
            const double rms = rmsDifference(seen.values, wanted.values, study_.dimensions);
            square_ += rms * rms;
            final_ = rms;
            most_ = std::max(most_, maxDifference(seen.values, wanted.values, study_.dimensions));
            return;
        }
        const StateSize is = shapeOf(seen, study_.dimensions), was = shapeOf(wanted, study_.dimensions);
        ++beyond_;
        meanEnergy_ += seen.energy - wanted.energy;
        extent_ += is.extent - was.extent;
        height_ += is.height - was.height;
    }

    void finish(RunPoint& point) const {
        const Reference& reference = study_.reference;
        point.rmsError = std::sqrt(square_ / study_.window);
        point.finalError = final_;
        point.maxError = most_;
        point.isAtFloor = point.rmsError < reference.floor;
        if (study_.hasEnergy && reference.kinetic > 0) {
            point.energyError = energy_ / reference.kinetic;
            point.isEnergyAtFloor = energy_ < reference.energyFloor;
        }
        if (!(point.rmsError <= reference.extent)) point.status = RunStatus::lost;
        if (beyond_ == 0) return;
        if (reference.kinetic > 0) point.meanEnergyError = std::abs(meanEnergy_) / beyond_ / reference.kinetic;
        point.extentError = std::abs(extent_) / beyond_;
        point.heightError = std::abs(height_) / beyond_;
    }

  private:
    const WorkPrecision& study_;
    double square_ = 0, final_ = 0, most_ = 0, energy_ = 0, meanEnergy_ = 0, extent_ = 0, height_ = 0;
    int beyond_ = 0;
};

// The points of a curve that are at a floor of any cause: from the first point on after which the error falls less
// than a third as fast with the step as it did, to the next point and on average to the last. Points above `most` are
// too coarse to show one.
std::span<RunPoint> floorOf(std::span<RunPoint> curve, double RunPoint::*error, double most, int order) {
    const auto slope = [&](std::size_t i, std::size_t j) {
        return std::log(curve[i].*error / curve[j].*error) / std::log(curve[i].step / curve[j].step);
    };
    double steepest = 1;
    for (std::size_t i = 2; i < curve.size(); ++i)
        if (curve[i - 2].*error < most) steepest = std::max(steepest, slope(i - 2, i));
    const double slow = std::min<double>(steepest, order) / 3;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i)
        if (curve[i].*error < most && slope(i, i + 1) < slow && slope(i, curve.size() - 1) < slow)
            return curve.subspan(i);
    return {};
}

class Sweep {
  public:
    Sweep(const Subject& subject, const StudySettings& settings, WorkPrecision& study, double secondsPerCurve)
        : subject_(subject), settings_(settings), study_(study), secondsPerCurve_(secondsPerCurve) {}

    void curve(const MethodFacts& method, Precision precision);
    bool isStopped() const { return settings_.listener.isStopped(); }
    std::function<void(double)> report;  // of 0 … 1 of the curve

  private:
    double firstStep(const MethodFacts& method) const;
    RunPoint run(const RunPlan& plan, double& seconds);
    void time(const RunPlan& plan, double estimate, RunPoint& point);

    const Subject& subject_;
    const StudySettings& settings_;
    WorkPrecision& study_;
    double secondsPerCurve_;
};

// Two to four times the stable step of the method; if no step is stable, of leap-frog.
double Sweep::firstStep(const MethodFacts& method) const {
    double limit = method.stepLimit;
    for (const MethodFacts& other : study_.methods)
        if (limit == 0 && other.name == "leapfrog") limit = other.stepLimit;
    if (limit == 0) limit = subject_.stepLimit(*ode::findMethod("leapfrog"));
    return std::min(study_.grid.spacing, 4 * limit);
}

RunPoint Sweep::run(const RunPlan& plan, double& seconds) {
    RunPoint point;
    point.method = plan.method;
    point.precision = plan.precision;
    point.step = plan.step();
    point.steps = plan.steps();
    const std::unique_ptr<Trial> trial = subject_.begin(plan);
    Gathering gathering(study_);
    ode::Work work = trial->work();
    double spent = 0;
    int sample = 0;
    for (; sample < plan.grid.samples; ++sample) {
        const ode::Work before = trial->work();
        const core::Stopwatch watch;
        const bool goesOn = trial->advance();
        spent += watch.seconds();
        const ode::Work after = trial->work();
        work.evaluations += after.evaluations - before.evaluations;
        work.iterations += after.iterations - before.iterations;
        work.unconverged += after.unconverged - before.unconverged;
        if (!goesOn) break;
        const Observation seen = trial->observe();
        gathering.add(sample, seen);
    }
    point.evaluations = work.evaluations;
    point.iterations = work.iterations;
    point.unconverged = work.unconverged;
    seconds = spent;
    if (sample < plan.grid.samples)
        point.status = RunStatus::diverged;
    else
        gathering.finish(point);
    return point;
}

// Whole runs without a look at them, each from a fresh start.
void Sweep::time(const RunPlan& plan, double estimate, RunPoint& point) {
    const int repeats = estimate < 1e-3 ? 15 : estimate < 0.03 ? 7 : estimate < 0.1 ? 5 : 3;
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) {
        const std::unique_ptr<Trial> trial = subject_.begin(plan);
        const core::Stopwatch watch;
        for (int sample = 0; sample < plan.grid.samples; ++sample)
            if (!trial->advance()) break;
        times.push_back(watch.seconds());
    }
    std::ranges::sort(times);
    const auto at = [&](double part) { return times[static_cast<std::size_t>(part * (repeats - 1) + 0.5)]; };
    point.fastSeconds = at(0.25);
    point.seconds = at(0.5);
    point.slowSeconds = at(0.75);
    point.repeats = repeats;
}

void Sweep::curve(const MethodFacts& method, Precision precision) {
    constexpr double leastSolverShare = 1e-8;
    const double runLimit = secondsPerCurve_ / 8;  // with its repeats and all the longer steps together eight times
    const std::size_t first = study_.points.size();
    RunPlan plan;
    plan.method = method.name;
    plan.precision = precision;
    plan.grid = study_.grid;
    plan.stepsPerSample = stepsPerSample(subject_, study_.grid, firstStep(method));
    const auto floor = [&] {
        return floorOf(std::span(study_.points).subspan(first), &RunPoint::rmsError, coarse * study_.reference.extent,
                       method.order);
    };
    double spent = 0, lastRun = 0;
    int good = 0;
    const bool isFixed = settings_.halvings > 0;
    const int most = isFixed ? settings_.halvings : 24;
    for (int halvings = 0; halvings <= most && !isStopped(); ++halvings, plan.stepsPerSample *= 2) {
        // As the step's own error falls: else the solves set a floor below which no step gets.
        plan.solverShare = std::max(leastSolverShare, std::pow(0.5, method.order * halvings));
        const double expected = 2 * lastRun;
        // A curve needs a slope: three points, unless they are out of all proportion.
        if (!isFixed && expected > runLimit * (good < 3 ? 4 : 1)) break;
        const core::Stopwatch watch;
        double seconds = 0;
        RunPoint point = run(plan, seconds);
        lastRun = point.status == RunStatus::diverged ? std::max(lastRun, seconds) : seconds;
        if (point.status == RunStatus::ok) {
            ++good;
            if (!isFixed) time(plan, seconds, point);
        }
        study_.points.push_back(point);
        spent += watch.seconds();
        if (report) report(std::min(0.95, spent / secondsPerCurve_));
        // Smaller steps tell nothing new.
        const bool isUnresolved = study_.points.size() > first + 1 && std::prev(study_.points.end(), 2)->isAtFloor;
        if (!isFixed && ((point.isAtFloor && isUnresolved) || floor().size() > 2)) break;
    }
    for (RunPoint& point : floor()) point.isAtFloor = true;
    const auto curve = std::span(study_.points).subspan(first);
    for (RunPoint& point : floorOf(curve, &RunPoint::energyError, coarse, method.order)) point.isEnergyAtFloor = true;
}

std::vector<MethodFacts> factsOfMethods(const Subject& subject, const std::vector<std::string>& names) {
    const auto fail = [](const std::string& what) { throw core::Error(core::ErrorKind::usage, what); };
    for (const std::string& name : names) {
        const ode::MethodInfo* info = ode::findMethod(name);
        if (info == nullptr)
            fail("there is no method '" + name + "'");
        else if (!subject.accepts(*info))
            fail(std::string(info->title) + " needs x'' = a(t, x, v); " + subject.name() + " is of first order");
    }
    std::vector<MethodFacts> facts;
    for (const ode::MethodInfo& info : chosenMethods(names))
        if (subject.accepts(info))
            facts.push_back({std::string(info.name), std::string(info.title), info.order, subject.stepLimit(info)});
    return facts;
}

void addRemarks(const Subject& subject, WorkPrecision& study) {
    const auto number = [](double value) { return fmt::format("{:.2g}", value); };
    const double duration = study.grid.duration();
    if (!study.reference.isExact)
        study.remarks.push_back("Errors are taken against " + methodOf(study.reference, study.unit) +
                                ": its own error, by the difference of the two runs, is about " +
                                number(study.reference.error) + (study.unit.empty() ? "." : " " + study.unit + "."));
    if (study.horizon.isReached)
        study.remarks.push_back("Chaotic: a shift of 1e-9 m grows a thousandfold within " +
                                number(study.horizon.seconds) + " s. Errors of positions are taken over the first " +
                                number(study.grid.spacing * study.window) + " s only; from there to " +
                                number(duration) + " s only energy, extent and mean height are compared.");
    if (study.window < 10)
        study.remarks.push_back("Only " + std::to_string(study.window) + " sample times lie within the horizon.");
    const bool anyUnresolved = std::ranges::any_of(
        study.points, [&](const RunPoint& point) { return point.rmsError < study.reference.floor; });
    if (anyUnresolved)
        study.remarks.push_back("Errors below " + number(study.reference.floor) +
                                ", 100 times the reference's own, are marked: they are not resolved.");
    if (study.hasContacts) study.remarks.push_back("There are contacts. " + subject.caution());
    if (study.isInterrupted) study.remarks.push_back("Interrupted: curves are missing.");
}

}  // namespace

std::string_view nameOf(RunStatus status) {
    return status == RunStatus::ok ? "ok" : status == RunStatus::diverged ? "diverged" : "lost";
}

WorkPrecision studyWorkPrecision(const Subject& subject, const StudySettings& settings) {
    WorkPrecision study;
    study.name = subject.name();
    study.title = subject.title();
    study.unit = subject.unit();
    study.dimensions = subject.dimensions();
    study.hasEnergy = subject.hasEnergy();
    study.methods = factsOfMethods(subject, settings.methods);
    double duration = settings.seconds > 0 ? settings.seconds : subject.duration();

    settings.listener.report(0.0, "horizon");
    study.horizon = subject.exact(0.0) ? Horizon{duration, false, 1.0} : findHorizon(subject, duration);
    // Unless asked for, not much of the motion that can be predicted in the mean only.
    if (settings.seconds == 0 && study.horizon.isReached) duration = std::min(duration, 3 * study.horizon.seconds);
    study.grid = subject.grid(duration, study.horizon.seconds);
    study.window =
        std::clamp(static_cast<int>(study.horizon.seconds / study.grid.spacing + 1e-6), 1, study.grid.samples);
    settings.listener.report(0.02, "reference");
    study.reference = makeReference(subject, study.grid, study.window, 0.1 * settings.budget);
    study.hasContacts = std::ranges::any_of(study.reference.at, &Observation::hasTouched);
    study.frame = subject.frame();

    const double before = 0.12;  // of the budget
    const auto curves = static_cast<double>(study.methods.size() * settings.precisions.size());
    Sweep sweep(subject, settings, study, (1 - before) * settings.budget / std::max(curves, 1.0));
    const core::ThreadLimit oneThread(1);  // curves are timed
    double done = 0;
    for (const MethodFacts& method : study.methods)
        for (const Precision precision : settings.precisions) {
            const std::string doing = method.name + ", " + std::string(nameOf(precision));
            sweep.report = [&](double part) {
                settings.listener.report(before + (1 - before) * (done + part) / curves, doing);
            };
            sweep.report(0);
            if (!sweep.isStopped()) sweep.curve(method, precision);
            done += 1;
        }
    study.isInterrupted = sweep.isStopped();
    addRemarks(subject, study);
    settings.listener.report(1.0, "done");
    return study;
}

double measuredOrder(const WorkPrecision& study, std::string_view method, Precision precision) {
    std::vector<const RunPoint*> curve;  // by falling step
    for (const RunPoint& p : study.points)
        if (p.method == method && p.precision == precision && p.status == RunStatus::ok) curve.push_back(&p);
    double least = HUGE_VAL;
    for (const RunPoint* p : curve) least = std::min(least, p->rmsError);
    const bool hasFloor = !curve.empty() && curve.back()->isAtFloor;
    const double low = hasFloor ? 30 * least : 0, extent = study.reference.extent;
    const double unit = precision == Precision::single_ ? 1.2e-7 : 2.2e-16;  // of rounding, each step may add one
    std::erase_if(curve, [&](const RunPoint* p) {
        return p->isAtFloor || p->rmsError < low || p->rmsError < unit * static_cast<double>(p->steps) * extent ||
               p->rmsError > coarse * extent;
    });
    if (curve.size() > 3) curve.erase(curve.begin(), curve.end() - 3);
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const RunPoint* p : curve) {
        const double x = std::log(p->step), y = std::log(p->rmsError);
        ++n, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return n < 3 ? RunPoint::unset : (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace taut::study
