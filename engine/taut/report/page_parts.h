// The style and the script of the page of test results, of assets/report: what never changes in it.
#pragma once

#include <string_view>

namespace taut::report {

std::string_view pageStyle();
std::string_view pageScript();

}  // namespace taut::report
