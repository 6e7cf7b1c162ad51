#include "taut/study/refinement_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "taut/core/private/contains.h"
#include "taut/report/column.h"

namespace taut::study {
namespace {

using report::In;

const RefinementFacts& factsOf(const RefinementStudy& study, const std::string& body) {
    return *std::ranges::find_if(
        study.bodies, [&](const RefinementFacts& facts) { return facts.body->name == body; });
}

report::Columns<RefinementRun> runColumns(const RefinementStudy& study) {
    return {{"body", &RefinementRun::body},
            {"quantity", [&study](const RefinementRun& run) { return factsOf(study, run.body).body->quantity; }},
            {"treatment", &RefinementRun::treatment},
            {"cells", &RefinementRun::cells},
            {"points", &RefinementRun::points},
            {"springs", &RefinementRun::springs},
            {"value_m", &RefinementRun::value},
            {"reference_m", [&study](const RefinementRun& run) { return factsOf(study, run.body).reference; }},
            {"reference", [&study](const RefinementRun& run) { return factsOf(study, run.body).body->theory; }},
            {"relative_error", &RefinementRun::error},
            {"order", &RefinementRun::order},
            {"residual", &RefinementRun::residual},
            {"steps", &RefinementRun::steps},
            {"settled", &RefinementRun::isAtRest}};
}

}  // namespace

std::string refinementCsv(const RefinementStudy& study) {
    return csv(tableOf(runColumns(study), study.runs, In::csv));
}

std::string refinementSummary(const RefinementStudy& study) {
    report::TextTable table;
    table.columns = {"body", "edges"};
    std::set<int> cells;
    for (const RefinementRun& run : study.runs) cells.insert(run.cells);
    for (const int n : cells) table.columns.push_back(fmt::format("[%] at {}", n));
    table.columns.emplace_back("order");
    for (const RefinementFacts& facts : study.bodies)
        for (const Treatment& treatment : treatments()) {
            std::vector<report::Cell> row = {facts.body->name, treatment.name};
            bool isThere = false;
            for (const int n : cells) {
                double percent = std::numeric_limits<double>::quiet_NaN();
                for (const RefinementRun& run : study.runs)
                    if (run.body == facts.body->name && run.treatment == treatment.name && run.cells == n) {
                        isThere = true;
                        if (run.isAtRest) percent = 100.0 * run.error;
                    }
                row.emplace_back(fmt::format("{:+.4f}", percent));
            }
            const double order = measuredOrder(study, facts.body->name, treatment.name);
            row.emplace_back(std::isnan(order) ? std::string("-") : fmt::format("{:.2f}", order));
            if (isThere) table.rows.push_back(std::move(row));
        }
    return report::aligned(table);
}

}  // namespace taut::study
