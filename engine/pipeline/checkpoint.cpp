#include "taut/pipeline/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "taut/core/bytes.h"
#include "taut/core/error.h"
#include "taut/pipeline/sealed_file.h"

namespace taut::pipeline {
namespace {

const SealedKind checkpointKind{"tautstat", 1, "checkpoint"};
constexpr std::string_view before = "checkpoint_", after = ".taut";

// Every number of a frame's metrics, in a fixed order.
template <class Metrics, class Visit>
void eachNumber(Metrics& m, const Visit& visit) {
    visit(m.time);
    visit(m.kinetic);
    visit(m.elastic);
    visit(m.gravitational);
    for (int i = 0; i < 3; ++i) visit(m.momentum[i]);
    for (int i = 0; i < 3; ++i) visit(m.angularMomentum[i]);
    visit(m.maxStrain);
    visit(m.contacts);
    visit(m.invertedCells);
    visit(m.brokenSprings);
    visit(m.volume);
    visit(m.restVolume);
    visit(m.penetration);
    visit(m.minVolumeRatio);
    visit(m.work.evaluations);
    visit(m.work.iterations);
    visit(m.work.unconverged);
}

void add(core::ByteWriter& writer, const FrameRecord& record) {
    writer.add(record.time);
    writer.add(record.hash);
    writer.add(record.pictured);
    for (double seconds : {record.simulating, record.drawing, record.encoding}) writer.add(seconds);
    writer.add(record.metrics.has_value());
    if (record.metrics) eachNumber(*record.metrics, [&](const auto& number) { writer.add(number); });
}

FrameRecord nextRecord(core::ByteReader& reader, std::int64_t frame) {
    FrameRecord record;
    record.frame = frame;
    record.time = reader.number<double>();
    record.hash = reader.number<std::uint64_t>();
    record.pictured = reader.number<bool>();
    for (double* seconds : {&record.simulating, &record.drawing, &record.encoding}) *seconds = reader.number<double>();
    if (reader.number<bool>()) {
        record.metrics.emplace();
        eachNumber(*record.metrics,
                   [&](auto& number) { number = reader.number<std::remove_reference_t<decltype(number)>>(); });
    }
    return record;
}

}  // namespace

void writeCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
    core::ByteWriter writer;
    writer.add(checkpoint.frame);
    writer.add(checkpoint.state);
    writer.add(checkpoint.picture);
    writer.addList(std::span<const std::byte>(checkpoint.world));
    writer.add(static_cast<std::uint64_t>(checkpoint.records.size()));
    for (const FrameRecord& record : checkpoint.records) add(writer, record);
    writeSealed(path, checkpointKind, writer.take());
}

Checkpoint readCheckpoint(const std::filesystem::path& path) {
    const std::vector<std::byte> content = readSealed(path, checkpointKind);
    core::ByteReader reader(content);
    try {
        Checkpoint checkpoint;
        checkpoint.frame = reader.number<std::int64_t>();
        checkpoint.state = reader.number<std::uint64_t>();
        checkpoint.picture = reader.number<std::uint64_t>();
        checkpoint.world = reader.list<std::byte>();
        const auto count = reader.number<std::uint64_t>();
        for (std::uint64_t i = 0; i < count; ++i)
            checkpoint.records.push_back(nextRecord(reader, static_cast<std::int64_t>(i)));
        if (!reader.isAtEnd() || static_cast<std::int64_t>(count) != checkpoint.frame) core::ByteReader::fail();
        return checkpoint;
    } catch (const core::Error& error) {
        throw core::Error(core::ErrorKind::badContent, fmt::format("{}: {}", path.string(), error.what()));
    }
}

std::filesystem::path CheckpointFolder::pathOf(std::int64_t frame) const {
    return folder_ / fmt::format("{}{:06}{}", before, frame, after);
}

std::vector<std::int64_t> CheckpointFolder::framesThere() const {
    std::vector<std::int64_t> frames;
    std::error_code none;  // a missing folder has no checkpoints
    for (const auto& entry : std::filesystem::directory_iterator(folder_, none)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(before) || !name.ends_with(after)) continue;
        const char* first = name.data() + before.size();
        const char* last = name.data() + name.size() - after.size();
        std::int64_t frame = 0;
        const auto [end, error] = std::from_chars(first, last, frame);
        if (error == std::errc{} && end == last) frames.push_back(frame);
    }
    std::sort(frames.begin(), frames.end());
    return frames;
}

std::optional<Checkpoint> CheckpointFolder::latest(std::int64_t frame,
                                                   const std::function<std::uint64_t(std::int64_t)>& keyOf,
                                                   std::vector<std::string>& refused) const {
    std::vector<std::int64_t> there = framesThere();
    while (!there.empty() && there.back() > frame) there.pop_back();
    for (; !there.empty(); there.pop_back()) {
        const std::filesystem::path path = pathOf(there.back());
        try {
            Checkpoint checkpoint = readCheckpoint(path);
            if (checkpoint.frame == there.back() && checkpoint.state == keyOf(there.back())) return checkpoint;
            refused.push_back(
                fmt::format("{}: this checkpoint is of another scene, or of something else that happens "
                            "before frame {}",
                            path.string(), there.back()));
        } catch (const core::Error& error) {
            if (error.kind() != core::ErrorKind::badContent) throw;
            refused.push_back(error.what());
        }
    }
    return std::nullopt;
}

}  // namespace taut::pipeline
