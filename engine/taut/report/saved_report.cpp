#include "taut/report/saved_report.h"

namespace taut::report {

void visit(core::Bytes& bytes, Verdict& verdict) {
    bytes.choice(verdict, Verdict::diverged);
}

void visit(core::Bytes& bytes, TestCheck& c) {
    bytes(c.verdict, c.that, c.span, c.value, c.bound, c.when, c.where, c.source, c.reason);
}

void visit(core::Bytes& bytes, TestState& s) {
    bytes(s.verdict, s.ticks, s.lastHash, s.reason, s.why, s.madeBy, s.word, s.bits);
}

void visit(core::Bytes& bytes, TestPicture& p) {
    bytes(p.verdict, p.key, p.frame, p.time, p.figures, p.reason, p.why, p.madeBy, p.isSame, p.isOfAnotherRenderer,
          p.golden, p.actual, p.difference, p.size, p.worstTile);
}

void visit(core::Bytes& bytes, TextChange& c) {
    bytes(c.sign, c.line, c.text);
}

void visit(core::Bytes& bytes, TestScenario& s) {
    bytes(s.name, s.title, s.file, s.verdict, s.faults, s.notes, s.checks, s.state, s.pictures, s.seconds,
          s.sceneSeconds, s.framesPerSecond, s.changes, s.accept);
}

void visit(core::Bytes& bytes, CalibrationRow& r) {
    bytes(r.scenario, r.picture, r.what, r.isMutant, r.hasPicture, r.hasState, r.share, r.tileShare, r.offset,
          r.largest, r.pictureDiffers, r.stateDiffers, r.meantFor, r.refusal);
}

void visit(core::Bytes& bytes, TestReport& r) {
    bytes(r.program, r.compiler, r.machine, r.renderer, r.tolerance, r.notes, r.outdated, r.scenarios, r.calibration,
          r.seconds);
}

}  // namespace taut::report
