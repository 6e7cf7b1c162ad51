#include "taut/regression/scenario_checks.h"

#include <fmt/format.h>

#include <filesystem>

namespace taut::regression {
namespace {

report::TestCheck reported(const check::Result& result, bool broken) {
    report::TestCheck check;
    check.that = result.that;
    check.span = result.span;
    check.source =
        fmt::format("{}:{}", std::filesystem::path(result.source.file).filename().string(), result.source.line);
    const std::optional<check::Sighting>& shown = result.first ? result.first : result.worst;
    if (shown) {
        check.value = check::quantityText(shown->outcome.value, shown->outcome.unit);
        check.bound = check::quantityText(shown->outcome.bound, shown->outcome.unit);
        check.when = check::momentText(*shown);
        check.where = shown->where;
    }
    if (result.passed) return check;
    // A check that did not fail and did not run to its end has no verdict.
    check.verdict = broken && !result.first ? report::Verdict::skipped : report::Verdict::failed;
    if (check.verdict == report::Verdict::failed) check.reason = result.reason;
    return check;
}

}  // namespace

std::vector<report::TestCheck> reported(const std::vector<check::Result>& results, bool broken) {
    std::vector<report::TestCheck> checks;
    for (const check::Result& result : results) checks.push_back(reported(result, broken));
    return checks;
}

}  // namespace taut::regression
