#include "taut/core/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "taut/core/error.h"

namespace taut::core {
namespace {

[[noreturn]] void failOn(const std::filesystem::path& path, const char* what, int error) {
    throw Error(ErrorKind::inputOutput, path.string() + ": " + what + ": " + std::strerror(error));
}

}  // namespace

std::filesystem::path temporaryName(const std::filesystem::path& path) {
    return path.parent_path() / (path.filename().string() + ".part");
}

void prepareFolderOf(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (std::error_code other; error && !std::filesystem::is_directory(folder, other))
        failOn(folder, "cannot make the folder", error.value());
    const WholeFile probe(path);
}

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), temporary_(temporaryName(path_)) {
    if (std::error_code error; std::filesystem::is_directory(path_, error)) failOn(path_, "cannot write", EISDIR);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) failOn(path_, "cannot write", errno);
}

WholeFile::~WholeFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(temporary_.c_str());
}

void WholeFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail("cannot write", errno);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
}

void WholeFile::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void WholeFile::commit() {
    // Some file systems report a full disk only now.
    if (::close(descriptor_) != 0) {
        const int error = errno;
        descriptor_ = -1;
        ::unlink(temporary_.c_str());
        failOn(path_, "cannot write", error);
    }
    descriptor_ = -1;
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary_.c_str());
        failOn(path_, "cannot rename the finished file", error);
    }
}

void WholeFile::fail(const char* what, int error) {
    ::close(descriptor_);
    descriptor_ = -1;
    ::unlink(temporary_.c_str());
    failOn(path_, what, error);
}

void writeWholeFile(const std::filesystem::path& path, std::string_view content) {
    WholeFile file(path);
    file.write(content);
    file.commit();
}

bool isThere(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

std::string fileContent(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) failOn(path, "cannot read", errno);
    std::string content;
    char buffer[1 << 16];
    for (;;) {
        const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            const int error = errno;
            ::close(descriptor);
            if (got < 0) failOn(path, "cannot read", error);
            return content;
        }
        content.append(buffer, static_cast<std::size_t>(got));
    }
}

}  // namespace taut::core
