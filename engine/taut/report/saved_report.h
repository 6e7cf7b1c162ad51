// A report as bytes and back, so that one may be made of several, by another process. It writes no file.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "taut/report/test_report.h"

namespace taut::report {

std::vector<std::byte> bytesOf(const TestReport& report);

// Throws core::Error(badContent) for bytes that are none of a report.
TestReport reportIn(std::span<const std::byte> bytes);

}  // namespace taut::report
