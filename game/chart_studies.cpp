#include "game/chart_studies.h"

#include "game/interruption.h"
#include "game/lab.h"
#include "game/messages.h"
#include "taut/study/refinement.h"
#include "taut/study/refinement_chart.h"

namespace taut::game {
namespace {

// The results of a study.
struct Written {
    std::string heading, summary, csv;
    std::vector<study::NamedChart> charts;
};

// studyWith(settings) and written(result): of a study whose settings have a listener.
template <class Settings, class Study, class Text>
int chartStudy(const char* name, const std::filesystem::path& folder, bool isQuiet, Settings settings,
               const Study& studyWith, const Text& written) {
    const Interruption interruption;
    const LabFolder output(folder, isQuiet);
    const auto result = followed(name, isQuiet, interruption, std::move(settings), studyWith);
    if (result.runs.empty()) return output.abandon(interruption);
    const Written all = written(result);
    output.write(std::string(name) + ".csv", all.csv);
    printResult("{}\n\n{}", all.heading, all.summary);
    for (const study::NamedChart& drawn : all.charts) output.draw(std::string(name) + "-" + drawn.name, drawn.chart);
    return output.finish(interruption);
}

}  // namespace

int chartRefinement(const std::filesystem::path& folder, const std::string& note, bool isQuiet,
                    study::RefinementSettings settings) {
    return chartStudy(
        "refinement", folder, isQuiet, std::move(settings), study::studyRefinement,
        [&](const study::RefinementStudy& result) {
            return Written{"Sag or stretch at rest against theory, by cells along the longest side",
                           study::refinementSummary(result), study::refinementCsv(result),
                           study::refinementCharts(result, {note})};
        });
}

int chartContact(const std::filesystem::path& folder, const std::string& note, bool isQuiet,
                 study::ContactSettings settings) {
    return chartStudy(
        "contact", folder, isQuiet, std::move(settings), study::studyContact,
        [&](const study::ContactStudy& result) {
            return Written{"Error of contact, by steps and detections of a tick of 1/60 s",
                           study::contactSummary(result), study::contactCsv(result),
                           study::contactCharts(result, {note})};
        });
}

std::span<const ChartStudy> chartStudies() {
    static constexpr ChartStudy all[] = {
        {"refinement", "error against resolution",
         "ropes, cloths and blocks at rest, at four resolutions, against theory", "bodies at rest",
         [](const auto& folder, const auto& note, bool isQuiet) { return chartRefinement(folder, note, isQuiet); }},
        {"contact", "error against detections and steps",
         "a ball that bounces, one that rolls, a box on a slope, a sheet on another, a rope that strikes itself",
         "numbers of detections and steps",
         [](const auto& folder, const auto& note, bool isQuiet) { return chartContact(folder, note, isQuiet); }}};
    return all;
}

}  // namespace taut::game
