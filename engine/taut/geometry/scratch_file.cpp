#include "taut/geometry/private/scratch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "taut/core/error.h"

namespace taut::geometry {
namespace {

constexpr std::size_t blockBytes = std::size_t{1} << 20U;

[[noreturn]] void failReading(const core::WholeFile& file) {
    throw core::Error(core::ErrorKind::inputOutput,
                      file.temporary().string() + ": cannot read: " + std::strerror(errno));
}

}  // namespace

ScratchFile::ScratchFile(const std::filesystem::path& path) : file_(path.string() + ".scratch") {
    reader_ = ::open(file_.temporary().c_str(), O_RDONLY | O_CLOEXEC);
    if (reader_ < 0) failReading(file_);
}

ScratchFile::~ScratchFile() {
    ::close(reader_);
}

ScratchFile::Piece ScratchFile::add(std::span<const std::byte> bytes) {
    const Piece piece{size(), bytes.size()};
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= blockBytes) flush();
    return piece;
}

void ScratchFile::flush() {
    file_.write(buffer_);
    written_ += buffer_.size();
    buffer_.clear();
}

void ScratchFile::visit(Piece piece, const std::function<void(std::span<const std::byte>)>& take) {
    TAUT_EXPECTS(piece.offset + piece.size <= size());
    if (!buffer_.empty()) flush();
    while (piece.size > 0) {
        copied_.resize(std::min<std::uint64_t>(piece.size, blockBytes));
        const ssize_t got = ::pread(reader_, copied_.data(), copied_.size(), static_cast<off_t>(piece.offset));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) failReading(file_);
        take(std::span(copied_).first(got));
        piece.offset += static_cast<std::uint64_t>(got);
        piece.size -= static_cast<std::uint64_t>(got);
    }
}

void ScratchFile::copy(Piece piece, core::WholeFile& to) {
    visit(
        piece, [&](std::span<const std::byte> bytes) { to.write(bytes); });
}

}  // namespace taut::geometry
