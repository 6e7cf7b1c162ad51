#include "taut/study/subject.h"

#include <algorithm>
#include <cmath>

#include "taut/core/private/contains.h"
#include "taut/ode/method_table.h"

namespace taut::study {

std::string_view nameOf(Precision precision) {
    return precision == Precision::single_ ? "single" : "double";
}

long long Subject::quantum(const Grid&) const {
    return 1;
}

std::optional<Observation> Subject::exact(double) const {
    return std::nullopt;
}

std::vector<ode::MethodInfo> chosenMethods(const std::vector<std::string>& names) {
    std::vector<ode::MethodInfo> chosen;
    for (const ode::MethodInfo& method : ode::methods())
        if (names.empty() || core::contains(names, method.name)) chosen.push_back(method);
    return chosen;
}

long long stepsPerSample(const Subject& subject, const Grid& grid, double step) {
    const double quantum = static_cast<double>(subject.quantum(grid));
    const double parts = std::max(1.0, std::ceil(grid.spacing / (step * quantum) * (1 - 1e-9)));
    return static_cast<long long>(parts * quantum);
}

}  // namespace taut::study
