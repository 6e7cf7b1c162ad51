#include "game/chart_refinement.h"

#include <fmt/format.h>

#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "taut/study/refinement.h"
#include "taut/study/refinement_chart.h"

namespace taut::game {

int chartRefinement(const std::filesystem::path& folder, const study::MachineFacts& machine, const std::string& note,
                    bool isQuiet, study::RefinementSettings settings) {
    const Interruption interruption;
    const LabFolder output(folder, isQuiet);
    const study::RefinementStudy result = [&] {
        LabProgress line(refinementName, isQuiet, interruption.flag());
        settings.stop = &interruption.flag();
        settings.progress = [&](double done, const std::string& doing) { line.show(done, doing); };
        return study::studyRefinement(settings);
    }();
    if (result.bodies.empty()) return output.abandon(interruption);
    output.write(std::string(refinementName) + ".csv", study::refinementCsv(result));
    output.write(std::string(refinementName) + ".json", study::refinementJson(result, machine));
    printResult("Sag or stretch at rest against theory, by cells along the longest side\n\n{}",
                study::refinementSummary(result));
    for (const study::NamedChart& drawn : study::refinementCharts(result, {note}))
        output.draw(std::string(refinementName) + "-" + drawn.name, drawn.chart);
    return output.finish(interruption);
}

}  // namespace taut::game
