// Joins frames that the parts of a run have drawn: proves that they are of one run, and makes a video. It knows no
// scene.
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

// All frames of the run, or the wanted ones. Throws core::Error(inputOutput) if records are not of one run: by their
// keys, their state hashes, or their renderers and versions of the program. Also if frames or records are missing,
// with a list of them, or if checksums of frames differ from the records.
FrameJoin provedFrames(const image::FramePattern& pattern, const std::optional<FrameRange>& wanted);

struct JoinedMetrics {
    std::string text;
    std::string fault;  // why there is no text although some parts have metrics
};
// metrics.csv of all parts: from each the lines of its own frames, and from the first also the lines before
// those. None if the parts have not all written the same columns.
JoinedMetrics joinedMetrics(const FrameJoin& join);

// Writes the frames into the sink. Returns false, with the sink not finished, if `stop` became true. Throws as the sink
// does, and core::Error for a picture that cannot be read.
bool encodeFrames(const FrameJoin& join, image::FrameSink& sink, bool quiet, const std::atomic<bool>& stop);

}  // namespace taut::game
