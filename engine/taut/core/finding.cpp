#include "taut/core/finding.h"

namespace taut::core {

Finding at(const Source& source) {
    return {Severity::error, source};
}

Finding warningAt(const Source& source) {
    return {Severity::warning, source};
}

Finding operator+(Finding finding, std::string_view more) {
    finding.text += more;
    return finding;
}

std::string printed(const Finding& finding) {
    const auto& [severity, source, text, remedy, excerpt] = finding;
    std::string all = source.file;
    for (const int number : {source.line, source.column})
        if (number > 0) all += ":" + std::to_string(number);
    if (!all.empty()) all += severity == Severity::error ? ": error: " : ": warning: ";
    all += text;
    if (!excerpt.empty()) all += "\n  " + excerpt;
    return remedy.empty() ? all : all + (excerpt.empty() ? "; " : " ") + remedy;
}

std::vector<std::string> printed(const std::vector<Finding>& findings) {
    std::vector<std::string> all;
    for (const Finding& finding : findings) all.push_back(printed(finding));
    return all;
}

}  // namespace taut::core
