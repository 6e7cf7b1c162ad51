// A run of tests as one HTML page that needs nothing besides: pictures, style and script are in it. It opens from a
// file and asks nothing of any network. It writes no file.
#pragma once

#include <string>

#include "taut/report/test_report.h"

namespace taut::report {

std::string testPage(const TestReport& report);

// For text and attributes.
std::string htmlText(const std::string& text);

}  // namespace taut::report
