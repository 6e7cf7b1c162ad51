#include "taut/study/phase_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "taut/core/private/contains.h"
#include "taut/ode/method_table.h"
#include "taut/study/oscillator.h"
#include "taut/study/subject.h"

namespace taut::study {

double phasePlaneStep() {
    return 2 * std::sin(std::numbers::pi / stepsPerTurn);
}

PhasePath phasePath(std::string_view method, double z, int steps) {
    PhasePath path;
    path.method = method;
    path.title = ode::findMethod(method)->title;
    Oscillator oscillator(0.0, Damping::none);
    const auto integrator = ode::makeMethod<double>(method, ode::MethodOptions{1, 1e-13, 100});
    ode::State<double> state(oscillator.layout());
    state.x[0] = 1;
    integrator->start(oscillator, 0.0, z, state);
    for (int n = 0; n <= steps; ++n) {
        if (n > 0) integrator->step(oscillator, z * (n - 1), z, state);
        double v = 0;
        integrator->synchronise(oscillator, z * n, z, state, &v);
        path.points.push_back({state.x[0], v});
    }
    const double end = std::hypot(path.points.back().x, path.points.back().v);
    path.growthPerTurn = std::pow(end, static_cast<double>(stepsPerTurn) / std::max(1, steps));
    return path;
}

std::vector<PhasePath> phasePaths(const std::vector<std::string>& methods) {
    std::vector<PhasePath> paths;
    for (const ode::MethodInfo& method : chosenMethods(methods))
        paths.push_back(phasePath(method.name, phasePlaneStep(), 2 * stepsPerTurn));
    return paths;
}

}  // namespace taut::study
