// Keeps the records of a run's frames in a file instead of in memory, because there may be many. It knows nothing about
// the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "taut/core/private/file_descriptor.h"
#include "taut/core/private/hash.h"
#include "taut/island/report.h"

namespace taut::pipeline {

struct FrameRecord {
    std::int64_t frame = 0;
    double time = 0.0;       // [s] of the scene
    std::uint64_t hash = 0;  // of the state, chained over ticks
    std::optional<world::Metrics> metrics{};
    bool pictured = false;    // false: simulated on the way to the first wanted frame, or without pictures
    double simulating = 0.0;  // [s] of wall time
    double drawing = 0.0;
    double encoding = 0.0;
    std::vector<double> figures{};  // RunOptions::figures; NaN: not measured
};

// Further metrics of each frame: the number of figures, and a key made of their names.
struct FigureColumns {
    std::size_t count = 0;
    std::uint64_t key = 0;
    bool operator==(const FigureColumns&) const = default;
};

// The records of frames 0, 1, …; all of them have the same size in the file. Calls throw core::Error: inputOutput when
// it cannot be written or read, badContent for a file that is foreign, of another version, or holds too few records.
class RecordLog {
  public:
    RecordLog() : RecordLog(FigureColumns{}) {}
    explicit RecordLog(const FigureColumns& figures);  // empty, without a name; deleted with the object
    RecordLog(const std::filesystem::path& path, const FigureColumns& figures);  // empty, under that name

    // Takes the first `count` records of an earlier run, either as a copy without a name or by continuing the same
    // file, whose other records are deleted. If the figures differ from those of the earlier run, they count as not
    // measured in its frames.
    static RecordLog copyOf(const std::filesystem::path& path, std::size_t count, const FigureColumns& figures = {});
    static RecordLog continuing(const std::filesystem::path& path, std::size_t count,
                                const FigureColumns& figures = {});

    // digest() of the first `count`.
    static std::uint64_t digestOf(const std::filesystem::path& path, std::size_t count);

    void add(const FrameRecord& record);  // expects that its frame is the next, and its figures as many as columns
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    FrameRecord operator[](std::size_t frame) const;  // expects frame < size()
    FrameRecord back() const { return (*this)[size_ - 1]; }

    // A digest of all records without their figures. It shows whether a file holds the same records.
    std::uint64_t digest() const { return digest_.value(); }

  private:
    RecordLog(int descriptor, std::filesystem::path path);
    static RecordLog opened(const std::filesystem::path& path, int mode, std::size_t count);
    void begin(const FigureColumns& figures);
    std::size_t recordWords() const;
    void moveToMemory();
    void readDigest(std::size_t count);
    void addAll(const RecordLog& other);

    core::FileDescriptor file_;
    std::filesystem::path path_;  // for messages
    bool isNameless_ = false;     // and not yet in memory
    FigureColumns figures_;
    std::size_t size_ = 0;
    core::Hash digest_;
};

}  // namespace taut::pipeline
