#include "taut/study/subject.h"

#include <algorithm>
#include <cmath>

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

long long stepsPerSample(const Subject& subject, const Grid& grid, double step) {
    const double quantum = static_cast<double>(subject.quantum(grid));
    const double parts = std::max(1.0, std::ceil(grid.spacing / (step * quantum) * (1 - 1e-9)));
    return static_cast<long long>(parts * quantum);
}

}  // namespace taut::study
