#include "taut/regression/scenario_text.h"

#include "taut/core/error.h"
#include "taut/core/whole_file.h"

namespace taut::regression {

std::string scenarioText(const Scenario& scenario) {
    std::string text = core::fileContent(scenario.file);
    for (const std::filesystem::path base : scenario.spec.bases) {
        if (!text.ends_with('\n')) text += '\n';
        text += "\n# " + base.filename().string() + ", which it builds on\n" + core::fileContent(base);
    }
    return text;
}

std::vector<report::TextChange> changedText(const Scenario& scenario, const GoldenFolder& folder) {
    try {
        const std::filesystem::path kept = folder.text(scenario.name);
        if (!core::isThere(kept)) return {};
        return report::textChanges(core::fileContent(kept), scenarioText(scenario));
    } catch (const core::Error&) {
        return {};  // a help for the reader of the report, which the verdict does not hang on
    }
}

bool keepText(const Scenario& scenario, const GoldenFolder& folder, core::FileBatch& files) {
    const std::filesystem::path kept = folder.text(scenario.name);
    const std::string text = scenarioText(scenario);
    if (core::isThere(kept) && core::fileContent(kept) == text) return false;
    core::writeWholeFile(files.replace(kept), text);
    return true;
}

}  // namespace taut::regression
