#include "taut/pipeline/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"
#include "taut/core/numbers.h"
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

void visit(core::Bytes& bytes, Checkpoint& checkpoint) {
    bytes(checkpoint.frame, checkpoint.state, checkpoint.picture, checkpoint.world, checkpoint.records,
          checkpoint.files);
    if (bytes.isAtEnd())
        checkpoint.bits = 1;
    else
        bytes(checkpoint.bits);
    bytes.require(checkpoint.frame >= 0 && world::areBits(checkpoint.bits));
}

void writeCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
    writeSealedValue(path, checkpointKind, checkpoint);
}

Checkpoint readCheckpoint(const std::filesystem::path& path, std::uint64_t maxBytes) {
    SealedKind kind = checkpointKind;
    kind.maxContent = maxBytes;
    return readSealedValue<Checkpoint>(path, kind);
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
        if (!name.starts_with(before) || !name.ends_with(after) || name.size() < before.size() + after.size()) continue;
        const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
        const auto frame = core::wholeIn<std::int64_t>(digits);
        if (frame && pathOf(*frame).filename() == name) frames.push_back(*frame);
    }
    std::ranges::sort(frames);
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
                if (std::ranges::none_of(refused, [](const auto& each) { return each.isOfOtherBits; }))
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
