// Reads the records of a run's parts: which frames each part has drawn, and whether all are parts of one run. It draws
// nothing and encodes nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "taut/image/frame_sequence.h"
#include "taut/render/renderer.h"

namespace taut::pipeline {

struct PartRecord {
    std::filesystem::path path;  // "out/run_120-239.json"
    std::string fault;           // why it is no record; empty: it is one
    std::string files;           // image::FramePattern::name() of its pictures
    std::string key;             // of the whole run; empty in records that have none
    std::string ended;           // "complete", "interrupted", "diverged"; "begun" while it is at work
    std::string scene, program;  // file, and version
    std::string size;            // "640 x 360"
    std::string renderer;        // rendererText()
    double fps = 60.0;
    bool hasAlpha = false;
    std::vector<std::string> besides;  // kinds of files beside the frames, "depth"
    int bits = 1;
    std::int64_t first = 0, last = 0;     // frames that it was to draw
    std::int64_t count = 0;               // frames of the whole run
    std::vector<std::uint64_t> hashes;    // of the states of frames 0, 1, …
    std::vector<std::uint32_t> pictures;  // image::checksumOf() of frames first, …

    // The last of its own frames that this part has drawn; below `first` if there is none.
    std::int64_t lastDrawn() const;
    // The checksum of a frame, if it is known.
    std::optional<std::uint32_t> pictureOf(std::int64_t frame) const;
};

// A key or a state as records have it, in 16 digits.
std::string hexadecimal(std::uint64_t hash);

// The renderer as records name it; empty if nothing was drawn.
std::string rendererText(const std::optional<render::RendererInfo>& info);

// "run_120-239.json"; "metrics", ".csv" gives "metrics_120-239.csv".
std::string partName(std::int64_t first, std::int64_t last, const std::string& stem = "run",
                     const std::string& extension = ".json");

// Throws core::Error: inputOutput, or badContent if the file is no record of a run.
PartRecord readPartRecord(const std::filesystem::path& path);

// Reads run.json and the records of parts in the folder of frames, sorted by first frame. Records that drew no frames,
// or files with other names, are left out. A record that cannot be read gets only path and fault.
std::vector<PartRecord> partRecords(const image::FramePattern& pattern);

// The frame files for which the folder has records, "p_######.png", sorted by name.
std::vector<std::string> recordedFiles(const std::filesystem::path& folder);

// How two records show that they are not of one run: "scenes flag.toml and drape.toml", "64 x 48 and 32 x 24 pixels",
// "other states from frame 12 on"; empty if they can be of one run.
std::string differenceOf(const PartRecord& a, const PartRecord& b);

struct FrameSpan {
    std::int64_t first = 0, last = 0;  // included
    bool operator==(const FrameSpan&) const = default;
};

// The frames of `wanted` that no record has drawn, as spans.
std::vector<FrameSpan> framesWithoutRecord(const std::vector<PartRecord>& records, const FrameSpan& wanted);

// The frames of `wanted` that are not among the given frames (ascending), as spans.
std::vector<FrameSpan> framesMissing(const std::vector<std::int64_t>& there, const FrameSpan& wanted);

// "frames 12, 60-119 and 3 more spans"; expects at least one.
std::string inWords(const std::vector<FrameSpan>& spans);

// Joins the records to that of one run: the record that knows most states, with the frames and the names of all parts.
// Expects that they are of one run.
void writeJoinedJson(const std::function<void(std::string_view)>& write, const std::vector<PartRecord>& records,
                     const FrameSpan& frames);

}  // namespace taut::pipeline
