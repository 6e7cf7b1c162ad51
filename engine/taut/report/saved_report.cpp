#include "taut/report/saved_report.h"

#include <string>
#include <type_traits>

#include "taut/core/bytes.h"

namespace taut::report {
namespace {

// Every member in a fixed order; the same for writing, with everything const, and for reading.
template <class Visit, class Check>
requires std::is_same_v<std::remove_const_t<Check>, TestCheck>
void visitMembers(const Visit& visit, Check& c) {
    visit(c.verdict, c.that, c.span, c.value, c.bound, c.when, c.where, c.source, c.reason);
}

template <class Visit, class State>
requires std::is_same_v<std::remove_const_t<State>, TestState>
void visitMembers(const Visit& visit, State& s) {
    visit(s.verdict, s.ticks, s.lastHash, s.reason, s.why, s.madeBy, s.word, s.bits);
}

template <class Visit, class Picture>
requires std::is_same_v<std::remove_const_t<Picture>, TestPicture>
void visitMembers(const Visit& visit, Picture& p) {
    visit(p.verdict, p.key, p.frame, p.time, p.figures, p.reason, p.why, p.madeBy, p.isSame, p.isOfAnotherRenderer,
          p.golden, p.actual, p.difference);
    for (auto& each : p.size) visit(each);
    for (auto& each : p.worstTile) visit(each);
}

template <class Visit, class Change>
requires std::is_same_v<std::remove_const_t<Change>, TextChange>
void visitMembers(const Visit& visit, Change& c) {
    visit(c.sign, c.line, c.text);
}

template <class Visit, class Scenario>
requires std::is_same_v<std::remove_const_t<Scenario>, TestScenario>
void visitMembers(const Visit& visit, Scenario& s) {
    visit(s.name, s.title, s.file, s.verdict, s.faults, s.notes, s.checks, s.state, s.pictures, s.seconds,
          s.sceneSeconds, s.framesPerSecond, s.changes, s.accept);
}

template <class Visit, class Row>
requires std::is_same_v<std::remove_const_t<Row>, CalibrationRow>
void visitMembers(const Visit& visit, Row& r) {
    visit(r.scenario, r.picture, r.what, r.isMutant, r.hasPicture, r.hasState, r.share, r.tileShare, r.offset,
          r.largest, r.pictureDiffers, r.stateDiffers, r.meantFor, r.refusal);
}

template <class Visit, class Report>
requires std::is_same_v<std::remove_const_t<Report>, TestReport>
void visitMembers(const Visit& visit, Report& r) {
    visit(r.program, r.compiler, r.machine, r.renderer, r.tolerance, r.notes, r.outdated, r.scenarios, r.calibration,
          r.seconds);
}

class Saving {
  public:
    explicit Saving(core::ByteWriter& writer) : writer_(writer) {}
    template <class... Members>
    void operator()(const Members&... members) const {
        (save(members), ...);
    }

  private:
    void save(const std::string& text) const { writer_.add(std::string_view(text)); }
    void save(const std::vector<std::byte>& bytes) const { writer_.addList(std::span<const std::byte>(bytes)); }
    void save(Verdict verdict) const { writer_.add(static_cast<std::int32_t>(verdict)); }
    template <class Item>
    void save(const std::vector<Item>& items) const {
        writer_.add(static_cast<std::uint64_t>(items.size()));
        for (const Item& item : items) save(item);
    }
    template <class Other>
    void save(const Other& other) const {
        if constexpr (std::is_arithmetic_v<Other>)
            writer_.add(other);
        else
            visitMembers(*this, other);
    }

    core::ByteWriter& writer_;
};

class Reading {
  public:
    explicit Reading(core::ByteReader& reader) : reader_(reader) {}
    template <class... Members>
    void operator()(Members&... members) const {
        (read(members), ...);
    }

  private:
    void read(std::string& text) const { text = reader_.text(); }
    void read(std::vector<std::byte>& bytes) const { bytes = reader_.list<std::byte>(); }
    void read(Verdict& verdict) const {
        const auto number = reader_.number<std::int32_t>();
        if (number < 0 || number > static_cast<std::int32_t>(Verdict::diverged)) core::ByteReader::fail();
        verdict = static_cast<Verdict>(number);
    }
    template <class Item>
    void read(std::vector<Item>& items) const {
        // One after the other: a count beyond the end of the bytes fails there.
        for (auto left = reader_.number<std::uint64_t>(); left > 0; --left) read(items.emplace_back());
    }
    template <class Other>
    void read(Other& other) const {
        if constexpr (std::is_arithmetic_v<Other>)
            other = reader_.number<Other>();
        else
            visitMembers(*this, other);
    }

    core::ByteReader& reader_;
};

}  // namespace

std::vector<std::byte> bytesOf(const TestReport& report) {
    core::ByteWriter writer;
    visitMembers(Saving(writer), report);
    return writer.take();
}

TestReport reportIn(std::span<const std::byte> bytes) {
    core::ByteReader reader(bytes);
    TestReport report;
    visitMembers(Reading(reader), report);
    if (!reader.isAtEnd()) core::ByteReader::fail();
    return report;
}

}  // namespace taut::report
