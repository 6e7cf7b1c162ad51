#include "taut/study/stability_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

#include "taut/core/private/bisect.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/parallel.h"
#include "taut/ode/method_table.h"
#include "taut/study/subject.h"

namespace taut::study {
namespace {

constexpr int mapSteps = 400;
constexpr double none = std::numeric_limits<double>::infinity();
constexpr ode::MethodOptions exactSolves{1, 1e-13, 100};

// One start under way. Everything that a method keeps is linear in the state, so all of it may be scaled.
class Run {
  public:
    Run(std::string_view method, Oscillator& system, double h, double x, double v)
        : system_(system), method_(ode::makeMethod<double>(method, exactSolves)), state_(system.layout()), h_(h) {
        state_.x[0] = x;
        state_.v[0] = v;
        method_->start(system_, 0.0, h_, state_);
    }
    void step() { method_->step(system_, h_ * n_++, h_, state_); }
    double energy() {
        double v = 0;
        method_->synchronise(system_, h_ * n_, h_, state_, &v);
        return state_.x[0] * state_.x[0] + v * v;
    }
    void scale(double factor) {
        state_.x[0] *= factor;
        state_.v[0] *= factor;
        for (auto& kept : state_.memory)
            for (double& value : kept) value *= factor;
    }

  private:
    Oscillator& system_;
    std::unique_ptr<ode::Method<double>> method_;
    ode::State<double> state_;
    double h_;
    int n_ = 0;
};

// The slope of values at 0, 1, 2, … by least squares with weights that fade at both ends.
double fadedSlope(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    double weight = 0, first = 0, second = 0, value = 0, product = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = (static_cast<double>(i) + 0.5) / n, w = at * at * (1 - at) * (1 - at);
        const double x = at - 0.5;  // weights are symmetric about it
        weight += w;
        first += w * x;
        second += w * x * x;
        value += w * values[i];
        product += w * x * values[i];
    }
    return (product - first * value / weight) / (second - first * first / weight) / n;
}

// A little growth may be a swing of the amplitude that is slower than the run; then eight times the steps show less.
bool stands(std::string_view method, double zeta, Damping damping, double z) {
    const double rate = measuredGrowth(method, zeta, damping, z, limitSteps) - 1;
    if (rate <= growthTolerance || rate > 1e-3) return rate <= growthTolerance;
    const double longer = measuredGrowth(method, zeta, damping, z, 8 * limitSteps) - 1;
    return longer <= growthTolerance || longer < 0.5 * rate;
}

class Measurement {
  public:
    explicit Measurement(const StabilityMapSettings& settings) : settings_(settings) {
        map_.columns = map_.rows = std::max(2, settings.columns);
        map_.steps = mapSteps;
        addPanels();
    }

    StabilityMap run() {
        for (std::size_t i = 0; i < map_.panels.size(); ++i) {
            StabilityPanel& panel = map_.panels[i];
            doing_ = panel.title;
            panel.boundaries.resize(std::max(2, settings_.boundaries));
            core::parallelFor(static_cast<int>(panel.boundaries.size()), [&](int b) { measureBoundary(panel, b); });
            if (panel.growth.empty()) continue;
            core::parallelFor(map_.rows, [&](int row) { measureRow(panel, row); });
        }
        for (StabilityPanel& panel : map_.panels) findGap(panel);
        map_.isInterrupted = settings_.listener.isStopped();
        return std::move(map_);
    }

  private:
    void addPanels() {
        for (const ode::MethodInfo& method : chosenMethods(settings_.methods)) {
            const bool isAlike =
                predictedLimit(method, 0.5, Damping::drag) == predictedLimit(method, 0.5, Damping::dashpot);
            for (const Damping damping : {Damping::drag, Damping::dashpot}) {
                StabilityPanel panel;
                panel.method = method.name;
                panel.title = method.title;
                panel.damping = damping;
                panel.isDampingAlike = isAlike;
                if (!isAlike || damping == Damping::drag) panel.growth.assign(map_.columns * map_.rows, 0.0);
                tasks_ += std::max(2, settings_.boundaries) + (panel.growth.empty() ? 0 : map_.rows);
                map_.panels.push_back(std::move(panel));
            }
        }
    }

    void measureBoundary(StabilityPanel& panel, int b) {
        if (settings_.listener.isStopped()) return;
        Boundary& boundary = panel.boundaries[b];
        boundary.zeta = map_.mostZeta * b / (static_cast<double>(panel.boundaries.size()) - 1);
        boundary.predicted = predictedLimit(*ode::findMethod(panel.method), boundary.zeta, panel.damping);
        boundary.measured =
            measuredLimit(panel.method, boundary.zeta, panel.damping, map_.mostMeasured, boundary.predicted);
        tell();
    }

    void measureRow(StabilityPanel& panel, int row) {
        if (settings_.listener.isStopped()) return;
        for (int column = 0; column < map_.columns; ++column)
            panel.growth[row * map_.columns + column] =
                measuredGrowth(panel.method, map_.zetaAt(column), panel.damping, map_.zAt(row), mapSteps);
        tell();
    }

    static void findGap(StabilityPanel& panel) {
        panel.isWithoutLimit = true;
        for (const Boundary& b : panel.boundaries) {
            if (std::isinf(b.predicted) && std::isinf(b.measured)) continue;
            panel.isWithoutLimit = false;
            const double gap = std::abs(b.measured - b.predicted);  // infinite when one of them is
            if (gap < panel.largestGap) continue;
            panel.largestGap = gap;
            panel.gapZeta = b.zeta;
        }
    }

    void tell() {
        const std::lock_guard lock(mutex_);
        ++done_;
        settings_.listener.report(static_cast<double>(done_) / tasks_, doing_);
    }

    const StabilityMapSettings& settings_;
    StabilityMap map_;
    std::mutex mutex_;
    std::string doing_;
    int done_ = 0, tasks_ = 0;
};

}  // namespace

double measuredGrowth(std::string_view method, double zeta, Damping damping, double z, int steps) {
    Oscillator oscillator(zeta, damping);
    Run runs[2] = {{method, oscillator, z, 1.0, 0.0}, {method, oscillator, z, 0.0, 1.0}};
    std::vector<double> logarithms;  // of the amplitude
    const int burn = steps / 2;
    logarithms.reserve(steps - burn);
    double scaled = 0;  // logarithm of all scaling so far
    for (int n = 0; n < steps; ++n) {
        for (Run& run : runs) run.step();
        const bool counts = n >= burn;
        if (!counts && n % 8 != 7) continue;
        const double energy = runs[0].energy() + runs[1].energy();
        if (!(energy > 1e-300)) return 0.0;
        if (counts) logarithms.push_back(0.5 * std::log(energy) + scaled);
        if (n % 8 != 7) continue;
        const double factor = 1 / std::sqrt(energy);
        for (Run& run : runs) run.scale(factor);
        scaled -= std::log(factor);
    }
    return std::exp(fadedSlope(logarithms));
}

double predictedLimit(const ode::MethodInfo& method, double zeta, Damping damping) {
    ode::FastestMode mode;
    mode.omega = 1;
    if (damping == Damping::dashpot) mode.tau = 2 * zeta;
    if (damping == Damping::drag) mode.drag = mode.largestDrag = 2 * zeta;
    return method.largestStep(mode);
}

double measuredLimit(std::string_view method, double zeta, Damping damping, double most, double suspected) {
    // Up to the first step that grows, then between it and the one before.
    constexpr double stride = 0.2, justAbove = 1.004;
    double low = 0, high = 0;
    for (int i = 1; high < most && low == high;) {
        const double next = std::min(stride * i, most), special = justAbove * suspected;
        const bool isSpecial = low < special && special < next;
        high = isSpecial ? special : next;
        if (!isSpecial) ++i;
        if (stands(method, zeta, damping, high)) low = high;
    }
    if (low == high) return none;
    constexpr int halvings = 18;  // to 1e-6
    return core::bisected(low, high, halvings, [&](double z) { return stands(method, zeta, damping, z); }).second;
}

StabilityMap measureStability(const StabilityMapSettings& settings) {
    return Measurement(settings).run();
}

}  // namespace taut::study
