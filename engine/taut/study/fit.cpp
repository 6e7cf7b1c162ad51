#include "taut/study/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "taut/check/figures.h"
#include "taut/core/error.h"
#include "taut/core/private/parallel.h"
#include "taut/scene/private/by_key.h"
#include "taut/spec/spec.h"
#include "taut/spec/ticks.h"
#include "taut/study/least_squares.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using world::FitTarget;

// A number of the scene and the unknown that it is sought by: its logarithm where it is positive, else its share of the
// way between the bounds.
struct Sought {
    double low, high;
    bool isLogarithmic() const { return low > 0; }
    double unknown(double value) const { return isLogarithmic() ? std::log(value) : value / (high - low); }
    // To six digits, as it is listed and written.
    double value(double unknown) const {
        const double value = isLogarithmic() ? std::exp(unknown) : unknown * (high - low);
        return std::clamp(std::stod(fmt::format("{:.6g}", value)), low, high);
    }
    // Of a value, for one of the unknown.
    double deviation(double value, double ofUnknown) const {
        return ofUnknown * (isLogarithmic() ? value : high - low);
    }
};

// (targets)(points) the values of a run at the places of the measurements.
struct FitRun {
    std::vector<std::vector<double>> values;
    std::string failure;
};

// One target, looked at tick by tick; between two ticks values run straight.
class Gauge {
  public:
    explicit Gauge(const FitTarget& target) : target_(target), figure_(check::Figures::parse(target.that)) {}

    void look(const world::World& world, double tick) {
        if (isDone() || next().time > world.time() + tick) return;
        const double value = figure_.of(world).front();
        for (; !isDone() && next().time <= world.time() + 1e-9;) {
            const double share = std::clamp((world.time() - next().time) / tick, 0.0, 1.0);
            values_.push_back(share > 1e-6 ? value + share * (last_ - value) : value);
        }
        last_ = value;
    }
    bool isDone() const { return values_.size() == target_.points.size(); }
    const std::vector<double>& values() const { return values_; }

  private:
    const FitTarget::Point& next() const { return target_.points[values_.size()]; }

    const FitTarget& target_;
    check::Figures figure_;
    std::vector<double> values_;
    double last_ = 0;  // at the tick before
};

FitRun play(const world::SceneSpec& scene, const std::vector<FitTarget>& targets, const std::atomic<bool>* stop) {
    FitRun run;
    try {
        world::World world(scene, {.threads = 1});
        const double tick = 1.0 / world::Ticks(scene.run).perSecond;
        std::vector<Gauge> gauges(targets.begin(), targets.end());
        while (true) {
            for (Gauge& gauge : gauges) gauge.look(world, tick);
            if (std::ranges::all_of(gauges, &Gauge::isDone)) break;
            if (stop != nullptr && stop->load()) throw core::Error(core::ErrorKind::interrupted, "stopped");
            if (const auto divergence = world.advance()) {
                run.failure = fmt::format("diverged at {:.3g} s", divergence->time);
                return run;
            }
        }
        for (const Gauge& gauge : gauges) run.values.push_back(gauge.values());
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::badContent) throw;
        run.failure = error.what();
    }
    for (std::size_t i = 0; i < run.values.size(); ++i)
        for (const double value : run.values[i])
            if (!std::isfinite(value)) run.failure = fmt::format("{} is no number", targets[i].that);
    return run;
}

class Fitting {
  public:
    Fitting(const world::SceneSpec& spec, const FitSettings& settings) : spec_(spec), settings_(settings) {
        for (std::size_t i = 0; i < spec.fit.keys.size(); ++i) sought_.push_back({spec.fit.low[i], spec.fit.high[i]});
        fit_.name = spec.file;
        for (const FitTarget& target : spec.fit.targets) fit_.values += static_cast<int>(target.points.size());
    }

    Fit run() {
        LeastSquares problem;
        problem.residuals = [&](const std::vector<Vector>& points) { return residualsAt(points); };
        problem.most = settings_.most;
        for (std::size_t i = 0; i < sought_.size(); ++i) {
            problem.start.push_back(sought_[i].unknown(spec_.fit.start[i]));
            problem.low.push_back(sought_[i].unknown(sought_[i].low));
            problem.high.push_back(sought_[i].unknown(sought_[i].high));
        }
        Minimum minimum = leastSquares(problem);
        if (minimum.residuals.empty())
            throw core::Error(core::ErrorKind::diverged, fmt::format("{}: the scene does not run as it is: {}",
                                                                     spec_.file, fit_.trials[0].failure));
        fit_.targets = targetsOf(minimum.residuals);
        if (!fit_.areTargetsMet()) seekElsewhere(problem, minimum);
        fit_.misfit = minimum.sum();
        fit_.hasConverged = minimum.hasConverged;
        fit_.unseen = minimum.unseen;
        addKeys(minimum);
        return std::move(fit_);
    }

  private:
    int trialsLeft() const { return settings_.most - static_cast<int>(fit_.trials.size()); }

    // Spends the remaining trials on minima from other starts, the most promising first.
    void seekElsewhere(LeastSquares problem, Minimum& best) {
        constexpr int places = 16, typicalSteps = 5;
        constexpr double clearly = 0.99;  // of the sum: another minimum, not the same one again
        const int forMinimum = typicalSteps * (2 * static_cast<int>(sought_.size()) + 3);
        if (trialsLeft() < places + forMinimum) return;
        for (const Vector& start : startsFor(problem, places)) {
            if (trialsLeft() < forMinimum) break;
            problem.start = start;
            problem.most = trialsLeft();
            const Minimum minimum = leastSquares(problem);
            ++fit_.starts;
            if (!(minimum.sum() < clearly * best.sum())) continue;
            best = minimum;
            fit_.targets = targetsOf(best.residuals);
            if (fit_.areTargetsMet()) break;
        }
    }

    // Places that fill the box of the unknowns evenly, by powers of the root of a^(n+1) = a + 1 (Kronecker's sequence),
    // in the order of their misfit.
    std::vector<Vector> startsFor(const LeastSquares& problem, int count) {
        const auto n = static_cast<double>(sought_.size());
        double root = 2;
        for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1 / (n + 1));
        std::vector<Vector> places;
        for (int k = 1; k <= count; ++k) {
            Vector& place = places.emplace_back();
            double part = k;
            for (std::size_t i = 0; i < sought_.size(); ++i) {
                part /= root;
                const double share = part - std::floor(part);
                place.push_back(problem.low[i] + share * (problem.high[i] - problem.low[i]));
            }
        }
        const std::size_t first = fit_.trials.size();
        residualsAt(places);
        std::vector<std::pair<double, Vector>> sorted;
        for (std::size_t k = 0; k < places.size(); ++k)
            if (const FitTrial& trial = fit_.trials[first + k]; trial.failure.empty())
                sorted.emplace_back(trial.misfit, places[k]);
        std::ranges::sort(sorted);
        places.clear();
        for (auto& [misfit, place] : sorted) places.push_back(std::move(place));
        return places;
    }

    std::vector<Vector> residualsAt(const std::vector<Vector>& points) {
        const std::size_t first = fit_.trials.size();
        for (const Vector& point : points) {
            FitTrial& trial = fit_.trials.emplace_back();
            for (std::size_t i = 0; i < sought_.size(); ++i) trial.values.push_back(sought_[i].value(point[i]));
        }
        std::vector<Vector> residuals(points.size());
        core::parallelFor(static_cast<int>(points.size()), [&](int k) {
            const auto i = static_cast<std::size_t>(k);
            FitTrial& trial = fit_.trials[first + i];
            const FitRun run = play(settings_.scene(trial.values), spec_.fit.targets, settings_.stop);
            trial.failure = run.failure;
            if (run.failure.empty()) residuals[i] = residualsOf(run);
            trial.misfit = run.failure.empty() ? 0 : HUGE_VAL;
            for (const double residual : residuals[i]) trial.misfit += residual * residual;
            const std::scoped_lock lock(mutex_);
            ++done_;
            if (settings_.progress) settings_.progress(trial, done_);
        });
        return residuals;
    }

    Vector residualsOf(const FitRun& run) const {
        Vector residuals;
        for (std::size_t t = 0; t < run.values.size(); ++t)
            for (std::size_t i = 0; i < run.values[t].size(); ++i) {
                const FitTarget::Point& point = spec_.fit.targets[t].points[i];
                residuals.push_back((run.values[t][i] - point.value) / point.sigma);
            }
        return residuals;
    }

    void addKeys(const Minimum& minimum) {
        const auto& covariance = minimum.covariance;
        for (std::size_t i = 0; i < sought_.size(); ++i) {
            FittedKey key{spec_.fit.keys[i], spec_.fit.start[i], sought_[i].value(minimum.x[i]), sought_[i].low,
                          sought_[i].high};
            key.isHeld = minimum.isHeld[i];
            key.isLogarithmic = sought_[i].isLogarithmic();
            key.deviation = sought_[i].deviation(key.value, minimum.deviation[i]);
            for (const Vector& direction : minimum.unseen)
                if (std::abs(direction[i]) > 0.1) key.deviation = std::numeric_limits<double>::quiet_NaN();
            if (key.value != key.before) fit_.changes.push_back({key.key, scene::numberText(key.value)});
            fit_.keys.push_back(std::move(key));
            Vector& row = fit_.correlation.emplace_back();
            for (std::size_t j = 0; j < sought_.size(); ++j)
                row.push_back(covariance[i][j] / std::sqrt(covariance[i][i] * covariance[j][j]));
        }
    }

    std::vector<FittedTarget> targetsOf(const Vector& residuals) const {
        std::vector<FittedTarget> targets;
        std::size_t next = 0;
        for (const FitTarget& target : spec_.fit.targets) {
            FittedTarget& done = targets.emplace_back();
            done.that = target.that;
            done.when = target.curve.empty() ? fmt::format("at {:.6g} s", target.points.front().time)
                                             : fmt::format("{} values of {}", target.points.size(), target.curve);
            double farthest = -1, sum = 0;
            for (const FitTarget::Point& point : target.points) {
                const double residual = residuals[next++];
                sum += residual * residual;
                if (std::abs(residual) <= farthest) continue;
                farthest = std::abs(residual);
                done.time = point.time;
                done.wanted = point.value;
                done.reached = point.value + residual * point.sigma;
            }
            done.off = std::sqrt(sum / static_cast<double>(target.points.size()));
        }
        return targets;
    }

    const world::SceneSpec& spec_;
    const FitSettings& settings_;
    std::vector<Sought> sought_;  // (keys)
    Fit fit_;
    std::mutex mutex_;
    int done_ = 0;
};

}  // namespace

bool Fit::areTargetsMet() const {
    return std::ranges::all_of(targets, &FittedTarget::isMet);
}

bool Fit::isMet() const {
    return hasConverged && unseen.empty() && areTargetsMet();
}

Fit makeFit(const world::SceneSpec& spec, const FitSettings& settings) {
    if (spec.fit.keys.empty())
        throw core::Error(core::ErrorKind::badContent, core::at({spec.file}) +
                                                           "the scene has nothing to fit: add [fit], for example\n\n"
                                                           "    [fit]\n"
                                                           "    keys = [\"material.m.bending_rigidity_N_m\"]\n"
                                                           "    low = [1e-7]\n"
                                                           "    high = [1e-3]\n\n"
                                                           "    [[fit.target]]\n"
                                                           "    that = \"lowest(cloth.strip)\"\n"
                                                           "    at = 3.0\n"
                                                           "    value = 0.031\n"
                                                           "    sigma = 0.001\n");
    return Fitting(spec, settings).run();
}

}  // namespace taut::study
