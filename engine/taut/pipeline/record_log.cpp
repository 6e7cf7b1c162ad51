#include "taut/pipeline/record_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "taut/core/error.h"
#include "taut/island/metric_table.h"

namespace taut::pipeline {
namespace {

// A file of words of 8 bytes: mark, version, words in a record without figures, count and key of the figures, then the
// records.
using Word = std::uint64_t;
static_assert(std::endian::native == std::endian::little, "words are copied as they lie in memory");
constexpr Word mark = 0x7363657274756174;  // "tautrecs"
constexpr Word version = 2;

template <class Number>
Word wordOf(Number number) {
    if constexpr (std::is_same_v<Number, double>)
        return std::bit_cast<Word>(number);
    else
        return static_cast<Word>(static_cast<std::int64_t>(number));
}

template <class Number>
void take(std::span<const Word>& words, Number& number) {
    if constexpr (std::is_same_v<Number, double>)
        number = std::bit_cast<double>(words.front());
    else
        number = static_cast<Number>(static_cast<std::int64_t>(words.front()));
    words = words.subspan(1);
}

std::vector<Word> wordsOf(const FrameRecord& record) {
    std::vector<Word> words = {wordOf(record.time),
                               record.hash,
                               wordOf(record.pictured),
                               wordOf(record.simulating),
                               wordOf(record.drawing),
                               wordOf(record.encoding),
                               wordOf(record.metrics.has_value())};
    world::Metrics metrics = record.metrics.value_or(world::Metrics{});
    world::eachNumber(metrics, [&](world::MetricNumber of) {
        std::visit([&](const auto* number) { words.push_back(wordOf(*number)); }, of);
    });
    return words;
}

FrameRecord recordIn(std::span<const Word> words, std::size_t frame) {
    FrameRecord record;
    record.frame = static_cast<std::int64_t>(frame);
    bool hasMetrics = false;
    take(words, record.time);
    record.hash = words.front();
    words = words.subspan(1);
    take(words, record.pictured);
    for (double* seconds : {&record.simulating, &record.drawing, &record.encoding}) take(words, *seconds);
    take(words, hasMetrics);
    world::Metrics metrics;
    world::eachNumber(metrics,
                      [&](world::MetricNumber of) { std::visit([&](auto* number) { take(words, *number); }, of); });
    if (hasMetrics) record.metrics = metrics;
    for (const Word word : words) record.figures.push_back(std::bit_cast<double>(word));
    return record;
}

std::size_t fixedWords() {
    static const std::size_t words = wordsOf({}).size();
    return words;
}

constexpr std::size_t headWords = 5;

off_t placeOf(std::size_t frame, std::size_t recordWords) {
    return static_cast<off_t>((headWords + frame * recordWords) * sizeof(Word));
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, int error) {
    throw core::Error(core::ErrorKind::inputOutput,
                      fmt::format("{}: cannot {}: {}", path.string(), what, std::strerror(error)));
}

void writeWords(int descriptor, off_t at, std::span<const Word> words, const std::filesystem::path& path) {
    std::span<const std::byte> bytes = std::as_bytes(words);
    while (!bytes.empty()) {
        const ssize_t done = ::pwrite(descriptor, bytes.data(), bytes.size(), at);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail(path, "write", errno);
        at += done;
        bytes = bytes.subspan(done);
    }
}

// False when the file ends before.
bool readWords(int descriptor, off_t at, std::span<Word> words, const std::filesystem::path& path) {
    std::span<std::byte> bytes = std::as_writable_bytes(words);
    while (!bytes.empty()) {
        const ssize_t got = ::pread(descriptor, bytes.data(), bytes.size(), at);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(path, "read", errno);
        if (got == 0) return false;
        at += got;
        bytes = bytes.subspan(got);
    }
    return true;
}

// Goes with its last descriptor. In memory only where no folder takes files.
int namelessFile() {
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
    const int file = ::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600);
    return file >= 0 ? file : ::memfd_create("records", MFD_CLOEXEC);
}

}  // namespace

RecordLog::RecordLog(int descriptor, std::filesystem::path path) : file_(descriptor), path_(std::move(path)) {
    if (descriptor < 0) fail(path_, "open the records of frames", errno);
}

RecordLog::RecordLog(const FigureColumns& figures) : RecordLog(namelessFile(), "records of frames") {
    isNameless_ = true;
    begin(figures);
}

RecordLog::RecordLog(const std::filesystem::path& path, const FigureColumns& figures)
    : RecordLog(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666), path) {
    begin(figures);
}

void RecordLog::begin(const FigureColumns& figures) {
    figures_ = figures;
    const Word head[headWords] = {mark, version, fixedWords(), figures.count, figures.key};
    writeWords(file_.get(), 0, head, path_);
}

std::size_t RecordLog::recordWords() const {
    return fixedWords() + figures_.count;
}

RecordLog RecordLog::opened(const std::filesystem::path& path, int mode, std::size_t count) {
    constexpr Word mostFigures = 100000;
    const int descriptor = ::open(path.c_str(), mode | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0 && errno == ENOENT)
        throw core::Error(core::ErrorKind::badContent, fmt::format("{}: the records are missing", path.string()));
    RecordLog log(descriptor, path);
    Word head[headWords] = {};
    if (!readWords(log.file_.get(), 0, head, path) || head[0] != mark || head[1] != version ||
        head[2] != fixedWords() || head[3] > mostFigures)
        throw core::Error(core::ErrorKind::badContent,
                          fmt::format("{}: these are no records of frames that this taut reads", path.string()));
    log.figures_ = {static_cast<std::size_t>(head[3]), head[4]};
    log.readDigest(count);
    return log;
}

RecordLog RecordLog::continuing(const std::filesystem::path& path, std::size_t count, const FigureColumns& figures) {
    RecordLog log = opened(path, O_RDWR, count);
    if (log.figures_ == figures) {
        if (::ftruncate(log.file_.get(), placeOf(count, log.recordWords())) != 0) fail(path, "write", errno);
        return log;
    }
    // Under another name until all of them are there.
    const std::filesystem::path fresh = path.string() + ".new";
    RecordLog other(fresh, figures);
    other.addAll(log);
    if (::rename(fresh.c_str(), path.c_str()) != 0) fail(path, "write", errno);
    return other;
}

RecordLog RecordLog::copyOf(const std::filesystem::path& path, std::size_t count, const FigureColumns& figures) {
    RecordLog copy(figures);
    copy.addAll(opened(path, O_RDONLY, count));
    return copy;
}

void RecordLog::addAll(const RecordLog& other) {
    for (std::size_t frame = 0; frame < other.size(); ++frame) {
        FrameRecord record = other[frame];
        if (figures_ != other.figures_) record.figures.assign(figures_.count, std::numeric_limits<double>::quiet_NaN());
        add(record);
    }
}

std::uint64_t RecordLog::digestOf(const std::filesystem::path& path, std::size_t count) {
    return opened(path, O_RDONLY, count).digest();
}

void RecordLog::readDigest(std::size_t count) {
    std::vector<Word> words(recordWords());
    for (; size_ < count; ++size_) {
        if (!readWords(file_.get(), placeOf(size_, recordWords()), words, path_))
            throw core::Error(core::ErrorKind::badContent,
                              fmt::format("{}: the records end with frame {}", path_.string(), size_));
        for (std::size_t i = 0; i < fixedWords(); ++i) digest_.add(words[i]);
    }
}

void RecordLog::moveToMemory() {
    isNameless_ = false;
    core::FileDescriptor memory(::memfd_create("records", MFD_CLOEXEC));
    if (memory.get() < 0) fail(path_, "keep the records of frames", errno);
    std::vector<Word> words(headWords);
    for (off_t at = 0; at < placeOf(size_, recordWords()); at += static_cast<off_t>(words.size() * sizeof(Word))) {
        words.resize(at == 0 ? headWords : recordWords());
        if (!readWords(file_.get(), at, words, path_)) fail(path_, "read", EIO);
        writeWords(memory.get(), at, words, path_);
    }
    file_ = std::move(memory);
}

void RecordLog::add(const FrameRecord& record) {
    TAUT_EXPECTS(record.frame == static_cast<std::int64_t>(size_));
    TAUT_EXPECTS(record.figures.size() == figures_.count);
    std::vector<Word> words = wordsOf(record);
    for (const Word word : words) digest_.add(word);
    for (const double figure : record.figures) words.push_back(wordOf(figure));
    try {
        writeWords(file_.get(), placeOf(size_, recordWords()), words, path_);
    } catch (const core::Error&) {
        if (!isNameless_) throw;
        moveToMemory();  // the disk is full that nobody asked to write to
        writeWords(file_.get(), placeOf(size_, recordWords()), words, path_);
    }
    ++size_;
}

FrameRecord RecordLog::operator[](std::size_t frame) const {
    TAUT_EXPECTS(frame < size_);
    std::vector<Word> words(recordWords());
    if (!readWords(file_.get(), placeOf(frame, recordWords()), words, path_)) fail(path_, "read", EIO);
    return recordIn(words, frame);
}

}  // namespace taut::pipeline
