#include "taut/geometry/points_writer.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <limits>

#include "taut/core/error.h"
#include "taut/core/whole_file.h"
#include "taut/geometry/private/format_table.h"
#include "taut/geometry/private/number_text.h"
#include "taut/geometry/private/scratch_file.h"

namespace taut::geometry {
namespace {

class CsvPoints : public PointsWriter {
  public:
    CsvPoints(const std::filesystem::path& path, std::vector<std::string> targets)
        : file_(path), targets_(std::move(targets)) {
        for (std::string& target : targets_)
            if (target.find(',') != std::string::npos) target = '"' + target + '"';
        file_.write("frame,time_s,target,point,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n");
    }

    void write(std::int64_t frame, double time, std::span<const PointSet> sets) override {
        TAUT_EXPECTS(sets.size() == targets_.size());
        text_.clear();
        std::string head = fmt::format("{},", frame);
        appendExactly(head, time);
        for (std::size_t s = 0; s < sets.size(); ++s)
            for (std::size_t i = 0; i < sets[s].x.size(); ++i) {
                text_ += head;
                text_ += ',';
                text_ += targets_[s];
                text_ += ',';
                text_ += fmt::format_int(i).c_str();
                addVector(sets[s].x[i]);
                addVector(sets[s].v[i]);
                text_ += '\n';
            }
        file_.write(text_);
    }
    void finish() override { file_.commit(); }

  private:
    void addVector(const glm::dvec3& vector) {
        for (int k = 0; k < 3; ++k) {
            text_ += ',';
            appendExactly(text_, vector[k]);
        }
    }

    core::WholeFile file_;
    std::vector<std::string> targets_;
    std::string text_;
};

// Numbers of a ZIP header, little-endian.
void append(std::string& to, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to += static_cast<char>((value >> (8 * i)) & 0xFFU);
}

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

class NpzPoints : public PointsWriter {
  public:
    NpzPoints(const std::filesystem::path& path, const std::vector<std::string>& targets)
        : path_(path), scratch_(path) {
        for (const std::string& target : targets) arrays_.push_back({target, 0, {}, {}});
    }

    void write(std::int64_t frame, double time, std::span<const PointSet> sets) override {
        TAUT_EXPECTS(sets.size() == arrays_.size());
        for (std::size_t s = 0; s < sets.size(); ++s) {
            Arrays& that = arrays_[s];
            if (!frames_.empty() && that.points != sets[s].x.size())
                throw core::Error(core::ErrorKind::badContent,
                                  fmt::format("{}: {} has {} points at frame {} and had {} before: write .csv, or take "
                                              "the frames from there on with --frames {}-",
                                              path_.string(), that.name, sets[s].x.size(), frame, that.points, frame));
            that.points = sets[s].x.size();
            that.x.add(std::as_bytes(sets[s].x), scratch_);
            that.v.add(std::as_bytes(sets[s].v), scratch_);
        }
        frames_.push_back(frame);
        times_.push_back(time);
    }

    void finish() override {
        core::WholeFile file(path_);
        std::string shape = fmt::format("({},)", frames_.size());
        put(file, "frame.npy", header("<i8", shape), bytesOf(frames_));
        put(file, "time.npy", header("<f8", shape), bytesOf(times_));
        for (const Arrays& that : arrays_) {
            shape = fmt::format("({}, {}, 3)", frames_.size(), that.points);
            put(file, that.name + ".x.npy", header("<f8", shape), that.x);
            put(file, that.name + ".v.npy", header("<f8", shape), that.v);
        }
        const std::uint64_t start = at_;
        std::string end = directory_;
        append(end, 0x06054B50, 4);
        for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{0}, entries_, entries_})
            append(end, value, 2);
        append(end, directory_.size(), 4);
        append(end, start, 4);
        append(end, 0, 2);
        file.write(end);
        file.commit();
    }

  private:
    // Data that comes frame by frame and is contiguous in the file.
    struct Series {
        std::vector<ScratchFile::Piece> pieces;
        std::uint64_t size = 0;
        void add(std::span<const std::byte> bytes, ScratchFile& scratch) {
            pieces.push_back(scratch.add(bytes));
            size += bytes.size();
        }
    };
    struct Arrays {
        std::string name;
        std::size_t points = 0;
        Series x, v;
    };

    // Version 1.0 of the format NPY: a Python dictionary, filled up so that the numbers begin at a multiple of 64.
    static std::string header(std::string_view type, const std::string& shape) {
        std::string words = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape);
        words.append(64 - (10 + words.size() + 1) % 64, ' ');
        words += '\n';
        std::string out = "\x93NUMPY";
        append(out, 1, 1);
        append(out, 0, 1);
        append(out, words.size(), 2);
        return out + words;
    }

    void put(core::WholeFile& file, const std::string& name, const std::string& head,
             std::span<const std::byte> bytes) {
        Series series;
        series.add(bytes, scratch_);
        put(file, name, head, series);
    }

    // Stored as it is. The check sum stands before the numbers, so that they are read twice.
    void put(core::WholeFile& file, const std::string& name, const std::string& head, const Series& series) {
        const std::uint64_t size = head.size() + series.size;
        if (at_ + size >= std::numeric_limits<std::uint32_t>::max())
            throw core::Error(core::ErrorKind::badContent,
                              path_.string() +
                                  ": more than 4 GB, the most that this format holds: leave frames out "
                                  "with --every or take some with --frames, or name fewer targets with --of");
        std::uint32_t crc = libdeflate_crc32(0, head.data(), head.size());
        for (const ScratchFile::Piece& piece : series.pieces)
            scratch_.visit(piece, [&](std::span<const std::byte> bytes) {
                crc = libdeflate_crc32(crc, bytes.data(), bytes.size());
            });

        std::string common;  // of the two headers
        append(common, 20, 2);
        for (const int zero : {0, 0, 0}) append(common, static_cast<std::uint64_t>(zero), 2);
        append(common, 0x21, 2);  // 1 January 1980, the first day that there is
        append(common, crc, 4);
        append(common, size, 4);
        append(common, size, 4);
        append(common, name.size(), 2);
        append(common, 0, 2);

        append(directory_, 0x02014B50, 4);
        append(directory_, 20, 2);
        directory_ += common;
        append(directory_, 0, 2);
        append(directory_, 0, 4);
        append(directory_, 0, 4);
        append(directory_, at_, 4);
        directory_ += name;
        ++entries_;

        std::string local;
        append(local, 0x04034B50, 4);
        local += common + name + head;
        file.write(local);
        for (const ScratchFile::Piece& piece : series.pieces) scratch_.copy(piece, file);
        at_ += local.size() + series.size;
    }

    std::filesystem::path path_;
    ScratchFile scratch_;
    std::vector<Arrays> arrays_;
    std::vector<std::int64_t> frames_;
    std::vector<double> times_;
    std::string directory_;
    std::uint64_t at_ = 0, entries_ = 0;
};

}  // namespace

Format npzFormat() {
    Format format{.name = "NPZ", .endings = {".npz"}, .readers = "numpy.load"};
    format.makePoints = [](const std::filesystem::path& path, const std::vector<std::string>& targets) {
        return std::make_unique<NpzPoints>(path, targets);
    };
    return format;
}

Format csvFormat() {
    Format format{.name = "CSV", .endings = {".csv"}};
    format.makePoints = [](const std::filesystem::path& path, const std::vector<std::string>& targets) {
        return std::make_unique<CsvPoints>(path, targets);
    };
    return format;
}

}  // namespace taut::geometry
