// Checkpoint files: whole or refused with a reason.
#include "taut/pipeline/checkpoint.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/pipeline/sealed_file.h"

namespace taut::pipeline {
namespace {

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

Checkpoint example(std::int64_t frame, std::uint64_t state) {
    Checkpoint checkpoint;
    checkpoint.frame = frame;
    checkpoint.state = state;
    checkpoint.picture = 5;
    checkpoint.world = content(64);
    for (std::int64_t i = 0; i < frame; ++i) {
        FrameRecord record{
            .frame = i, .time = 0.1 * static_cast<double>(i), .hash = 77U + static_cast<std::uint64_t>(i)};
        record.pictured = i % 2 == 1;
        record.drawing = 0.25;
        if (i > 0) {
            record.metrics.emplace();
            record.metrics->kinetic = 3.5;
            record.metrics->angularMomentum = {1, 2, 3};
            record.metrics->brokenSprings = 4;
            record.metrics->work.iterations = 12;
        }
        checkpoint.records.push_back(record);
    }
    return checkpoint;
}

TEST(Checkpoint, GivesBackEveryRecord) {
    const std::filesystem::path folder = emptyFolder("records");
    writeCheckpoint(folder / "c.taut", example(3, 9));
    const Checkpoint back = readCheckpoint(folder / "c.taut");
    EXPECT_EQ(back.frame, 3);
    EXPECT_EQ(back.state, 9U);
    EXPECT_EQ(back.picture, 5U);
    EXPECT_EQ(back.world, content(64));
    ASSERT_EQ(back.records.size(), 3U);
    EXPECT_EQ(back.records[2].frame, 2);
    EXPECT_EQ(back.records[2].time, 0.2);
    EXPECT_EQ(back.records[2].hash, 79U);
    EXPECT_FALSE(back.records[2].pictured);
    EXPECT_TRUE(back.records[1].pictured);
    EXPECT_EQ(back.records[1].drawing, 0.25);
    EXPECT_FALSE(back.records[0].metrics);
    ASSERT_TRUE(back.records[1].metrics);
    EXPECT_EQ(back.records[1].metrics->kinetic, 3.5);
    EXPECT_EQ(back.records[1].metrics->angularMomentum, glm::dvec3(1, 2, 3));
    EXPECT_EQ(back.records[1].metrics->brokenSprings, 4);
    EXPECT_EQ(back.records[1].metrics->work.iterations, 12);
}

TEST(CheckpointFolder, FindsTheLastThatFits) {
    const CheckpointFolder folder(emptyFolder("latest"));
    for (std::int64_t frame : {10, 20, 30, 40})
        writeCheckpoint(folder.pathOf(frame), example(frame, frame < 30 ? 1 : 2));
    std::ofstream(folder.pathOf(15)) << "nothing of the sort";
    std::ofstream(folder.path() / "checkpoint_x.taut") << "not ours";
    EXPECT_EQ(folder.framesThere(), (std::vector<std::int64_t>{10, 15, 20, 30, 40}));

    const auto always = [](std::uint64_t key) { return [key](std::int64_t) { return key; }; };
    std::vector<std::string> refused;
    EXPECT_EQ(folder.latest(40, always(2), refused)->frame, 40);
    EXPECT_EQ(folder.latest(39, always(2), refused)->frame, 30);
    EXPECT_TRUE(refused.empty());
    EXPECT_EQ(folder.latest(40, always(1), refused)->frame, 20) << "what happens from frame 30 on is new";
    EXPECT_EQ(refused.size(), 2U);
    refused.clear();
    EXPECT_EQ(folder.latest(19, always(1), refused)->frame, 10);
    ASSERT_EQ(refused.size(), 1U);
    EXPECT_NE(refused[0].find("checkpoint_000015.taut: this is no checkpoint of taut"), std::string::npos);
    EXPECT_FALSE(folder.latest(9, always(1), refused));
    EXPECT_FALSE(CheckpointFolder(folder.path() / "missing").latest(9, always(1), refused));
}

// A file under another's name would put the pictures out of step.
TEST(CheckpointFolder, DoesNotTrustNames) {
    const CheckpointFolder folder(emptyFolder("names"));
    writeCheckpoint(folder.pathOf(10), example(11, 1));
    std::vector<std::string> refused;
    EXPECT_FALSE(folder.latest(
        20, [](std::int64_t) { return 1; }, refused));
    EXPECT_EQ(refused.size(), 1U);
}

}  // namespace
}  // namespace taut::pipeline
