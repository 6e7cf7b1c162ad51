// Frames that the parts of a run have drawn: proved to be one run's, and made a video. It knows no scene.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "game/flags.h"
#include "taut/image/frame_sequence.h"
#include "taut/image/frame_sink.h"
#include "taut/pipeline/run_parts.h"

namespace taut::game {

struct FrameJoin {
    image::FramePattern pattern;
    std::vector<pipeline::PartRecord> records;  // at least one
    pipeline::FrameSpan frames;
    bool hasAlpha() const { return records.front().hasAlpha; }
    double fps() const { return records.front().fps; }
};

// All frames of the run, or those wanted. Throws core::Error(inputOutput) where records are not of one run, by their
// keys, their renderers and versions of the program unless any will do, or their state hashes; where frames or records
// are missing, with all that is; and where frames are not as records say, by their checksums.
FrameJoin provedFrames(const image::FramePattern& pattern, const std::optional<FrameRange>& wanted,
                       bool takesAnyRenderer);

struct JoinedMetrics {
    std::string text;
    std::string fault;  // why there is no text, where some parts have metrics
};
// metrics.csv of all parts: of each the lines of its own frames, and before the first what that one has. None where not
// all have written the same columns.
JoinedMetrics joinedMetrics(const FrameJoin& join);

// Into the sink, which is not finished where `stop` became true: false then. Throws what the sink throws, and
// core::Error for a picture that cannot be read.
bool encodeFrames(const FrameJoin& join, image::FrameSink& sink, bool quiet, const std::atomic<bool>& stop);

}  // namespace taut::game
