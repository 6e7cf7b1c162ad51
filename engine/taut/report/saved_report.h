// The members of a report for core::Bytes, so that one report may be made of several, by another process. It writes no
// file.
#pragma once

#include "taut/core/bytes.h"
#include "taut/report/test_report.h"

namespace taut::report {

void visit(core::Bytes& bytes, Verdict& verdict);
void visit(core::Bytes& bytes, TestCheck& check);
void visit(core::Bytes& bytes, TestState& state);
void visit(core::Bytes& bytes, TestPicture& picture);
void visit(core::Bytes& bytes, TextChange& change);
void visit(core::Bytes& bytes, TestScenario& scenario);
void visit(core::Bytes& bytes, CalibrationRow& row);
void visit(core::Bytes& bytes, TestReport& report);

}  // namespace taut::report
