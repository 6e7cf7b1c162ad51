// A run of tests as JUnit XML, which the usual CI systems read. It writes no file.
#pragma once

#include <string>

#include "taut/report/test_report.h"

namespace taut::report {

// A suite for each scenario with a case for the run, each check, the state and each picture. A missing golden is a
// failure of type "missing"; an outdated one was skipped.
std::string junitXml(const TestReport& report);

}  // namespace taut::report
