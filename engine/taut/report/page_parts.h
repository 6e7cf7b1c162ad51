// The style and the script of the page of test results, of assets/report: its constant part.
#pragma once

#include <string_view>

namespace taut::report {

std::string_view pageStyle();
std::string_view pageScript();

}  // namespace taut::report
