#include "taut/pipeline/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "taut/core/bytes.h"
#include "taut/core/error.h"
#include "taut/pipeline/sealed_file.h"

namespace taut::pipeline {
namespace {

const SealedKind checkpointKind{
    .mark = "tautstat", .version = 3, .title = "checkpoint", .oldest = 2};  // 2: without bits
constexpr std::string_view before = "checkpoint_", after = ".taut";

// ": sail.obj has changed"; empty where no file has.
std::string changesSince(const Checkpoint& checkpoint) {
    std::string text;
    for (const std::string& change : scene::changedSince(checkpoint.files))
        text += (text.empty() ? ": " : ", ") + change;
    return text;
}

}  // namespace

void writeCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
    core::ByteWriter writer;
    writer.add(checkpoint.frame);
    writer.add(checkpoint.state);
    writer.add(checkpoint.picture);
    writer.addList(std::span<const std::byte>(checkpoint.world));
    writer.add(checkpoint.records);
    scene::addUsedFiles(writer, checkpoint.files);
    writer.add(static_cast<std::int32_t>(checkpoint.bits));
    writeSealed(path, checkpointKind, writer.take());
}

Checkpoint readCheckpoint(const std::filesystem::path& path, std::uint64_t maxBytes) {
    SealedKind kind = checkpointKind;
    kind.maxContent = maxBytes;
    const std::vector<std::byte> content = readSealed(path, kind);
    core::ByteReader reader(content);
    try {
        Checkpoint checkpoint;
        checkpoint.frame = reader.number<std::int64_t>();
        checkpoint.state = reader.number<std::uint64_t>();
        checkpoint.picture = reader.number<std::uint64_t>();
        checkpoint.world = reader.list<std::byte>();
        checkpoint.records = reader.number<std::uint64_t>();
        checkpoint.files = scene::nextUsedFiles(reader);
        checkpoint.bits = reader.isAtEnd() ? 1 : reader.number<std::int32_t>();
        if (!reader.isAtEnd() || checkpoint.frame < 0 || !world::areBits(checkpoint.bits)) core::ByteReader::fail();
        return checkpoint;
    } catch (const core::Error& error) {
        throw core::Error(core::ErrorKind::badContent, fmt::format("{}: {}", path.string(), error.what()));
    }
}

std::filesystem::path CheckpointFolder::pathOf(std::int64_t frame) const {
    return folder_ / fmt::format("{}{:06}{}", before, frame, after);
}

std::filesystem::path CheckpointFolder::records() const {
    return folder_ / "records.taut";
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
        if (error == std::errc{} && end == last && frame >= 0 && pathOf(frame).filename() == name)
            frames.push_back(frame);
    }
    std::sort(frames.begin(), frames.end());
    return frames;
}

std::optional<Checkpoint> CheckpointFolder::latest(std::int64_t frame,
                                                   const std::function<std::uint64_t(std::int64_t)>& keyOf,
                                                   std::uint64_t maxBytes, std::vector<PassedOver>& refused) const {
    std::vector<std::int64_t> there = framesThere();
    while (!there.empty() && there.back() > frame) there.pop_back();
    for (; !there.empty(); there.pop_back()) {
        const std::filesystem::path path = pathOf(there.back());
        try {
            Checkpoint checkpoint = readCheckpoint(path, maxBytes);
            if (checkpoint.bits != world::resultBits) {  // first: its keys may differ for that alone
                if (std::none_of(refused.begin(), refused.end(), [](const auto& each) { return each.isOfOtherBits; }))
                    refused.push_back(
                        {fmt::format("{}: this checkpoint was {}", path.string(), world::recordedBy(checkpoint.bits)),
                         true});
            } else if (checkpoint.frame != there.back() || checkpoint.state != keyOf(there.back())) {
                refused.push_back(
                    {fmt::format("{}: this checkpoint is of another scene, or of something else that happens "
                                 "before frame {}{}",
                                 path.string(), there.back(), changesSince(checkpoint))});
            } else if (RecordLog::digestOf(records(), static_cast<std::size_t>(there.back())) != checkpoint.records) {
                refused.push_back(
                    {fmt::format("{}: {} is of another run", path.string(), records().filename().string())});
            } else {
                return checkpoint;
            }
        } catch (const core::Error& error) {
            refused.push_back({error.what()});
        }
    }
    return std::nullopt;
}

}  // namespace taut::pipeline
