// Checkpoint files: whole or refused with a reason.
#include "taut/pipeline/checkpoint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/island/metric_table.h"
#include "taut/pipeline/run_lock.h"
#include "taut/pipeline/sealed_file.h"

namespace taut::pipeline {
namespace {

constexpr std::uint64_t mostBytes = 1000000;  // [bytes]

const SealedKind kind{"tauttest", 3, "test file"};

std::filesystem::path emptyFolder(const char* name) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "taut_checkpoints" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

std::vector<std::byte> content(int size) {
    std::mt19937 random(7);
    std::vector<std::byte> bytes;
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(random() % 9));
    return bytes;
}

std::string refusal(const std::vector<std::byte>& bytes) {
    try {
        unsealed(kind, bytes, "a.taut");
    } catch (const core::Error& error) {
        EXPECT_EQ(error.kind(), core::ErrorKind::badContent);
        return error.what();
    }
    return "";
}

TEST(SealedFile, GivesItsContentBack) {
    for (int size : {0, 1, 7, 8, 9, 100000}) {
        const std::vector<std::byte> bytes = sealed(kind, content(size));
        EXPECT_EQ(unsealed(kind, bytes, "a.taut"), content(size)) << size;
    }
    EXPECT_LT(sealed(kind, content(100000)).size(), 60000U) << "nine values take 3.2 of 8 bits";
}

TEST(SealedFile, OfAnotherKindIsRefused) {
    EXPECT_EQ(refusal(sealed({"tautsome", 3, "other"}, content(9))), "a.taut: this is no test file of taut");
    EXPECT_EQ(refusal(content(3)), "a.taut: this is no test file of taut");
}

TEST(SealedFile, OfAnotherVersionIsRefused) {
    EXPECT_EQ(refusal(sealed({"tauttest", 4, "test file"}, content(9))),
              "a.taut: this test file has format 4, and this taut reads format 3: it was written by a newer one");
    EXPECT_EQ(refusal(sealed({"tauttest", 2, "test file"}, content(9))),
              "a.taut: this test file has format 2, and this taut reads format 3: it was written by an older one");
}

// A million zeros pack into a thousandth: nothing is taken on their word.
TEST(SealedFile, ThatWouldTakeTooMuchUnpackedIsRefused) {
    SealedKind small = kind;
    small.maxContent = 999999;
    try {
        unsealed(small, sealed(kind, std::vector<std::byte>(1000000)), "a.taut");
        FAIL();
    } catch (const core::Error& error) {
        EXPECT_STREQ(error.what(), "a.taut: unpacked, this test file would take 1 MB; up to 1 MB are taken");
    }
}

TEST(SealedFile, WithOneBitChangedOrCutShortIsRefused) {
    const std::vector<std::byte> whole = sealed(kind, content(300));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::vector<std::byte> damaged = whole;
        damaged[i] ^= static_cast<std::byte>(1U << (i % 8));
        EXPECT_NE(refusal(damaged), "") << "byte " << i;
        damaged = whole;
        damaged.resize(i);
        EXPECT_NE(refusal(damaged), "") << "cut to " << i;
    }
}

FrameRecord recordOf(std::int64_t i) {
    FrameRecord record{.frame = i, .time = 0.1 * static_cast<double>(i), .hash = 77U + static_cast<std::uint64_t>(i)};
    record.pictured = i % 2 == 1;
    record.drawing = 0.25;
    if (i > 0) {
        record.metrics.emplace();
        record.metrics->kinetic = 3.5;
        record.metrics->angularMomentum = {1, 2, 3};
        record.metrics->brokenSprings = 4;
        record.metrics->work.iterations = 12;
    }
    return record;
}

void expectSame(const FrameRecord& back, const FrameRecord& record) {
    EXPECT_EQ(back.frame, record.frame);
    EXPECT_EQ(back.time, record.time);
    EXPECT_EQ(back.hash, record.hash);
    EXPECT_EQ(back.pictured, record.pictured);
    EXPECT_EQ(back.drawing, record.drawing);
    ASSERT_EQ(back.metrics.has_value(), record.metrics.has_value());
    if (!back.metrics) return;
    EXPECT_EQ(back.metrics->kinetic, record.metrics->kinetic);
    EXPECT_EQ(back.metrics->angularMomentum, record.metrics->angularMomentum);
    EXPECT_EQ(back.metrics->brokenSprings, record.metrics->brokenSprings);
    EXPECT_EQ(back.metrics->work.iterations, record.metrics->work.iterations);
}

// For any rows: every number of a row has a value of its own here.
TEST(RecordLog, KeepsWhatEveryMetricIsMadeOf) {
    FrameRecord record;
    double next = 0.0;
    world::eachNumber(record.metrics.emplace(), [&](world::MetricNumber of) {
        std::visit([&](auto* number) { *number = static_cast<std::decay_t<decltype(*number)>>(next += 1.0); }, of);
    });
    RecordLog log;
    log.add(record);
    for (const world::Metric& metric : world::metricTable()) {
        EXPECT_EQ(metric.value(*log[0].metrics), metric.value(*record.metrics)) << metric.columns;
        EXPECT_NE(metric.value(*record.metrics), metric.value({})) << metric.columns << ": a number is not visited";
    }
}

void addUpTo(RecordLog& log, std::int64_t end) {
    for (auto i = static_cast<std::int64_t>(log.size()); i < end; ++i) log.add(recordOf(i));
}

TEST(RecordLog, GivesBackEveryRecordAndGoesOnWhereItIsTold) {
    const std::filesystem::path path = emptyFolder("log") / "records.taut";
    std::uint64_t atThree = 0;
    {
        RecordLog log(path, {});
        addUpTo(log, 3);
        atThree = log.digest();
        addUpTo(log, 5);
        for (std::size_t i = 0; i < 5; ++i) expectSame(log[i], recordOf(static_cast<std::int64_t>(i)));
    }
    const RecordLog copy = RecordLog::copyOf(path, 4);
    expectSame(copy.back(), recordOf(3));
    EXPECT_EQ(RecordLog::digestOf(path, 3), atThree);
    RecordLog log = RecordLog::continuing(path, 3);
    EXPECT_EQ(log.digest(), atThree);
    FrameRecord other = recordOf(3);
    other.time = 7.0;
    log.add(other);
    expectSame(log[3], other);
    EXPECT_THROW(RecordLog::copyOf(path, 5), core::Error) << "the fourth of before is forgotten";
    std::ofstream(path) << "nothing of the sort";
    EXPECT_THROW(RecordLog::copyOf(path, 0), core::Error);
}

TEST(RecordLog, KeepsFiguresAndKnowsThatOthersWereNotMeasured) {
    const std::filesystem::path path = emptyFolder("figures") / "records.taut";
    const FigureColumns two{2, 7}, otherTwo{2, 8};
    std::uint64_t digest = 0;
    {
        RecordLog log(path, two);
        for (std::int64_t i = 0; i < 3; ++i) {
            FrameRecord record = recordOf(i);
            record.figures = {1.0 * static_cast<double>(i), 0.1};
            log.add(record);
        }
        digest = log.digest();
    }
    EXPECT_EQ(RecordLog::copyOf(path, 3, two)[2].figures, (std::vector<double>{2.0, 0.1}));
    EXPECT_TRUE(std::isnan(RecordLog::copyOf(path, 3, otherTwo)[2].figures.at(1)));
    const RecordLog without = RecordLog::continuing(path, 3);
    EXPECT_TRUE(without[1].figures.empty());
    expectSame(without[1], recordOf(1));
    EXPECT_EQ(RecordLog::digestOf(path, 3), digest);
}

Checkpoint example(std::int64_t frame, std::uint64_t state) {
    RecordLog log;
    addUpTo(log, frame);
    return {frame, state, 5, content(64), log.digest()};
}

TEST(Checkpoint, GivesBackWhatItWasGiven) {
    const std::filesystem::path folder = emptyFolder("records");
    writeCheckpoint(folder / "c.taut", example(3, 9));
    const Checkpoint back = readCheckpoint(folder / "c.taut", mostBytes);
    EXPECT_EQ(back.frame, 3);
    EXPECT_EQ(back.state, 9U);
    EXPECT_EQ(back.picture, 5U);
    EXPECT_EQ(back.world, content(64));
    EXPECT_EQ(back.records, example(3, 9).records);
}

// The size of a checkpoint does not grow with the frames before it: a run's stay linear in its length.
TEST(Checkpoint, TakesNoMoreLaterInTheRun) {
    const std::filesystem::path folder = emptyFolder("linear");
    writeCheckpoint(folder / "early.taut", example(1, 9));
    writeCheckpoint(folder / "late.taut", example(300, 9));
    EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(folder / "late.taut")),
                static_cast<double>(std::filesystem::file_size(folder / "early.taut")), 16.0);
}

TEST(CheckpointFolder, FindsTheLastThatFits) {
    const CheckpointFolder folder(emptyFolder("latest"));
    RecordLog log(folder.records(), {});
    addUpTo(log, 40);
    for (std::int64_t frame : {10, 20, 30, 40})
        writeCheckpoint(folder.pathOf(frame), example(frame, frame < 30 ? 1 : 2));
    std::ofstream(folder.pathOf(15)) << "nothing of the sort";
    std::ofstream(folder.path() / "checkpoint_x.taut") << "not ours";
    std::string below = folder.pathOf(40).string();
    below[below.find_last_of('_') + 1] = '-';
    std::ofstream(below) << "not ours";
    EXPECT_EQ(folder.framesThere(), (std::vector<std::int64_t>{10, 15, 20, 30, 40}));

    const auto always = [](std::uint64_t key) { return [key](std::int64_t) { return key; }; };
    std::vector<PassedOver> refused;
    EXPECT_EQ(folder.latest(40, always(2), mostBytes, refused)->frame, 40);
    EXPECT_EQ(folder.latest(39, always(2), mostBytes, refused)->frame, 30);
    EXPECT_TRUE(refused.empty());
    EXPECT_EQ(folder.latest(40, always(1), mostBytes, refused)->frame, 20) << "what happens from frame 30 on is new";
    EXPECT_EQ(refused.size(), 2U);
    refused.clear();
    EXPECT_EQ(folder.latest(19, always(1), mostBytes, refused)->frame, 10);
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_NE(refused[0].why.find("checkpoint_000015.taut: this is no checkpoint of taut"), std::string::npos);
    EXPECT_FALSE(folder.latest(9, always(1), mostBytes, refused));
    refused.clear();
    RecordLog::continuing(folder.records(), 25);
    EXPECT_EQ(folder.latest(30, always(2), mostBytes, refused), std::nullopt) << "the records end before";
    EXPECT_NE(refused.at(0).why.find("records.taut: the records end with frame 25"), std::string::npos)
        << refused[0].why;
    EXPECT_FALSE(CheckpointFolder(folder.path() / "missing").latest(9, always(1), mostBytes, refused));
}

TEST(RunLock, LetsPartsOfOneRunInAndNobodyElse) {
    const std::filesystem::path folder = emptyFolder("lock");
    std::ofstream(folder / ".taut-lock") << "left by a process that was killed";
    const auto refusal = [&](const RunParty& party) -> std::string {
        try {
            const RunLock lock(folder, party);
        } catch (const core::Error& error) {
            EXPECT_EQ(error.kind(), core::ErrorKind::inputOutput);
            return error.what();
        }
        return "";
    };
    {
        const RunLock first(folder, {1, "the first"});
        EXPECT_NE(refusal({2, "other"}).find("another run is writing here (the first)"), std::string::npos);
        EXPECT_NE(refusal({std::nullopt, "alone"}), "");
        const RunLock part(folder, {1, "its part"});
        EXPECT_EQ(refusal({1, "another part"}), "");
        EXPECT_NE(refusal({2, "other"}), "");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    const RunLock alone(folder, {std::nullopt, "alone"});
    EXPECT_NE(refusal({std::nullopt, "alone too"}).find("(alone)"), std::string::npos);
    EXPECT_NE(refusal({1, "the first"}), "");
}

// The number is the last of the content; format 2 ends before it.
TEST(Checkpoint, KeepsItsBitsAndWithoutANumberIsOfBitsOne) {
    const std::filesystem::path folder = emptyFolder("bits");
    Checkpoint checkpoint = example(3, 9);
    checkpoint.bits = 77;
    writeCheckpoint(folder / "c.taut", checkpoint);
    EXPECT_EQ(readCheckpoint(folder / "c.taut", mostBytes).bits, 77);
    std::vector<std::byte> bytes = readSealed(folder / "c.taut", {"tautstat", 3, "checkpoint"});
    bytes.back() = std::byte{0xff};  // below zero
    writeSealed(folder / "d.taut", {"tautstat", 3, "checkpoint"}, bytes);
    EXPECT_THROW(readCheckpoint(folder / "d.taut", mostBytes), core::Error);
    bytes.resize(bytes.size() - sizeof(std::int32_t));
    writeSealed(folder / "d.taut", {"tautstat", 2, "checkpoint"}, bytes);
    EXPECT_EQ(readCheckpoint(folder / "d.taut", mostBytes).bits, 1);
}

TEST(CheckpointFolder, PassesOverThoseOfOtherBitsAndSaysSoOnce) {
    const CheckpointFolder folder(emptyFolder("otherbits"));
    RecordLog log(folder.records(), {});
    addUpTo(log, 30);
    for (std::int64_t frame : {10, 20, 30}) {
        Checkpoint checkpoint = example(frame, 1);
        if (frame > 10) checkpoint.bits = world::resultBits + 1;
        writeCheckpoint(folder.pathOf(frame), checkpoint);
    }
    std::vector<PassedOver> refused;
    EXPECT_EQ(folder
                  .latest(
                      30, [](std::int64_t) { return 1; }, mostBytes, refused)
                  ->frame,
              10);
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_TRUE(refused[0].isOfOtherBits);
    EXPECT_NE(refused[0].why.find("checkpoint_000030.taut: this checkpoint was recorded by bits"), std::string::npos);
}

// A file under another's name would put the pictures out of step.
TEST(CheckpointFolder, DoesNotTrustNames) {
    const CheckpointFolder folder(emptyFolder("names"));
    writeCheckpoint(folder.pathOf(10), example(11, 1));
    std::vector<PassedOver> refused;
    EXPECT_FALSE(folder.latest(
        20, [](std::int64_t) { return 1; }, mostBytes, refused));
    EXPECT_EQ(refused.size(), 1U);
}

}  // namespace
}  // namespace taut::pipeline
