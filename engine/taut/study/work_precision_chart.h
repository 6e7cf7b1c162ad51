// The pictures of a work-precision study, as descriptions that report draws.
#pragma once

#include <string>
#include <vector>

#include "taut/report/chart.h"
#include "taut/study/work_precision.h"

namespace taut::study {

struct NamedChart {
    std::string name;  // "time", "evaluations", "energy", "statistics": the end of the file name
    report::Chart chart;
};

// Error against wall time and against force evaluations; with energies, their error against the step; and if the motion
// outlasts its horizon, statistics beyond it. `notes` stand at the foot: the machine, the program.
std::vector<NamedChart> workPrecisionCharts(const WorkPrecision& study, const std::vector<std::string>& notes);

}  // namespace taut::study
