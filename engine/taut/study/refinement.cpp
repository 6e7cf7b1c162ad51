#include "taut/study/refinement.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/study/statics.h"

namespace taut::study {
namespace {

bool isChosen(const RefinementSettings& settings, const RefinementBody& body) {
    return settings.bodies.empty() || core::contains(settings.bodies, body.name);
}

bool applies(const RefinementBody& body, const Treatment& treatment) {
    return body.hasEdgeSprings || !treatment.lumped.areSpringsNaive;
}

RefinementRun runOf(const RefinementBody& body, const Treatment& treatment, int cells) {
    const mechanics::Model model = body.build(cells, treatment.lumped);
    const Equilibrium rest = equilibrium(model, refinementGravity);
    RefinementRun run;
    run.body = body.name;
    run.treatment = treatment.name;
    run.cells = cells;
    run.points = model.pointCount();
    run.springs = static_cast<long long>(model.springs.size());
    run.value = body.value(rest.positions, cells);
    run.residual = rest.residual;
    run.steps = rest.steps;
    run.isAtRest = rest.isAtRest;
    return run;
}

// The limit of ever finer bodies (Richardson): the three finest give the order, the last difference the rest. An order
// that is out of reason is taken as 1.
double limitOf(const std::vector<RefinementRun>& series) {
    const double a = series[series.size() - 3].value, b = series[series.size() - 2].value, c = series.back().value;
    const double fall = (b - a) / (c - b);
    return c + (c - b) / ((fall > 1.2 && fall < 20.0 ? fall : 2.0) - 1.0);
}

void findErrors(std::vector<RefinementRun>& series, double reference) {
    for (std::size_t i = 0; i < series.size(); ++i) {
        series[i].error = series[i].value / reference - 1.0;
        if (i == 0) continue;
        const double before = series[i - 1].error, now = series[i].error;
        const bool isAbove = std::abs(before) > refinementFloor && std::abs(now) > refinementFloor;
        if (isAbove && before / now > 0.0) series[i].order = std::log2(before / now);  // not where it changes sign
    }
}

}  // namespace

const std::vector<Treatment>& treatments() {
    static const std::vector<Treatment> all = {
        {"weighted", "edges weighted by their share", {false, false}},
        {"naive-mass", "naive mass: m = M/n", {true, false}},
        {"naive-springs", "naive springs: full stiffness at edges", {false, true}},
        {"naive", "naive mass and springs", {true, true}},
    };
    return all;
}

RefinementStudy studyRefinement(const RefinementSettings& settings) {
    TAUT_EXPECTS(settings.cells.size() >= 3);
    RefinementStudy study;
    // Cost grows with the points: blocks take most of the time.
    double all = 0.0, done = 0.0;
    const auto costOf = [](const RefinementBody& body, int cells) {
        return std::pow(static_cast<double>(cells), body.name.starts_with("rope")    ? 1
                                                    : body.name.starts_with("cloth") ? 2.5
                                                                                     : 4);
    };
    const auto forAll = [&](const auto& visit) {
        for (const RefinementBody& body : refinementBodies())
            if (isChosen(settings, body)) visit(body);
    };
    forAll([&](const RefinementBody& body) {
        for (const Treatment& treatment : treatments())
            for (const int cells : settings.cells) all += applies(body, treatment) ? costOf(body, cells) : 0.0;
    });
    forAll([&](const RefinementBody& body) {
        RefinementFacts facts{&body, body.exact.value_or(0.0), {}};
        std::vector<RefinementRun> runs;
        for (const Treatment& treatment : treatments()) {
            facts.strongest.push_back(std::numeric_limits<double>::quiet_NaN());
            if (!applies(body, treatment)) continue;
            std::vector<RefinementRun> series;
            for (const int cells : settings.cells) {
                if (settings.listener.isStopped()) study.isInterrupted = true;
                if (study.isInterrupted) return;
                settings.listener.report(done / all, body.name + ", " + treatment.name);
                series.push_back(runOf(body, treatment, cells));
                done += costOf(body, cells);
            }
            if (!body.exact && treatment.name == treatments().front().name) facts.reference = limitOf(series);
            findErrors(series, facts.reference);
            for (const RefinementRun& run : series)
                facts.strongest.back() = std::fmax(facts.strongest.back(), std::abs(run.error));
            runs.insert(runs.end(), series.begin(), series.end());
        }
        study.bodies.push_back(std::move(facts));
        study.runs.insert(study.runs.end(), runs.begin(), runs.end());
    });
    settings.listener.report(1.0, "");
    return study;
}

double measuredOrder(const RefinementStudy& study, const std::string& body, const std::string& treatment) {
    const RefinementRun* finest = nullptr;
    for (const RefinementRun& run : study.runs)
        if (run.body == body && run.treatment == treatment) finest = &run;
    return finest != nullptr && finest->isAtRest ? finest->order : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace taut::study
