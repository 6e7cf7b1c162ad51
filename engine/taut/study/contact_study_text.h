// A study of contact as text and pictures: CSV for programs, a table for people, a chart drawn by report.
#pragma once

#include <string>
#include <vector>

#include "taut/study/contact_study.h"
#include "taut/study/work_precision_chart.h"

namespace taut::study {

// A row a run; units stand in the names of the columns.
std::string contactCsv(const ContactStudy& study);
// A line a problem and number of steps: the error with each number of detections in per cent.
std::string contactSummary(const ContactStudy& study);

// "detections": error against the detections of a tick, a panel a problem and a curve a number of steps. `notes` stand
// at the foot.
std::vector<NamedChart> contactCharts(const ContactStudy& study, const std::vector<std::string>& notes);

}  // namespace taut::study
