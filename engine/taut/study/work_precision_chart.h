// The pictures of a work-precision study, as descriptions that report draws.
#pragma once

#include <string>
#include <vector>

#include "taut/report/chart.h"
#include "taut/study/work_precision.h"

namespace taut::study {

struct NamedChart {
    std::string name;  // "time", "evaluations", "energy", "statistics": what the file name ends with
    report::Chart chart;
};

// Error against wall time and against force evaluations; with energies, their error against the step; and where the
// motion outlasts its horizon, what can be said beyond it. `notes` stand at the foot: the machine, the program.
std::vector<NamedChart> workPrecisionCharts(const WorkPrecision& study, const std::vector<std::string>& notes);

}  // namespace taut::study
