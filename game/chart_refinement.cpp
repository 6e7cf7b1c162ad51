#include "game/chart_refinement.h"

#include <fmt/format.h>

#include <chrono>

#include "core/error.h"
#include "game/interruption.h"
#include "game/live_line.h"
#include "game/messages.h"
#include "game/progress.h"
#include "image/whole_file.h"
#include "report/gnuplot.h"
#include "study/refinement.h"
#include "study/refinement_chart.h"

namespace taut::game {

int chartRefinement(const std::filesystem::path& folder, const study::MachineFacts& machine, const std::string& note,
                    bool isQuiet, study::RefinementSettings settings) {
    const auto file = [&](const std::string& ending) { return folder / (refinementName + ending); };
    image::prepareFolderOf(file(".csv"));
    const bool draws = !report::gnuplotVersion().empty();
    if (!draws) printWarnings({report::gnuplotMissing() + "; only CSV and JSON will be written"});

    const Interruption interruption;
    LiveLine line(isQuiet);
    const auto start = std::chrono::steady_clock::now();
    settings.stop = &interruption.flag();
    settings.progress = [&](double done, const std::string& doing) {
        if (!line.isDue(done >= 1.0)) return;
        const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        line.show(fmt::format("{} {:3.0f} %  {} left  {}", refinementName, 100 * done,
                              clockText(done > 0.01 ? spent * (1.0 / done - 1.0) : 0.0), doing));
    };
    const study::RefinementStudy result = study::studyRefinement(settings);
    image::writeWholeFile(file(".csv"), study::refinementCsv(result));
    image::writeWholeFile(file(".json"), study::refinementJson(result, machine));
    fmt::print("Sag or stretch at rest against theory, by cells along the longest side\n\n{}",
               study::refinementSummary(result));
    if (draws)
        for (const study::NamedChart& drawn : study::refinementCharts(result, {note}))
            report::writeChart(drawn.chart, file("-" + drawn.name));
    if (!isQuiet) fmt::print(stderr, "in {}\n", folder.string());
    if (!draws) throw core::Error(core::ExitCode::inputOutput, "no pictures: " + report::gnuplotMissing());
    return static_cast<int>(interruption.exitCode().value_or(core::ExitCode::ok));
}

}  // namespace taut::game
