#include "taut/core/whole_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>

#include "taut/core/error.h"
#include "taut/core/private/file_descriptor.h"
#include "taut/core/private/file_lock.h"

namespace taut::core {
namespace {

[[noreturn]] void failOn(const std::filesystem::path& path, const char* what, int error) {
    const bool isFull = error == ENOSPC || error == EDQUOT || error == EFBIG;
    throw Error(ErrorKind::inputOutput, path.string() + ": " + what + ": " + std::strerror(error) +
                                            (isFull ? "; make room for it, or write to another disk" : ""));
}

// Removes the file that a killed process has left under a temporary name; a link is not followed. False when it is
// being written, by a process that lives.
bool hasRemovedLeftOver(const std::filesystem::path& path, const std::filesystem::path& temporary) {
    const int left = ::open(temporary.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    const bool isLink = left < 0 && errno == ELOOP;
    if (left < 0 && errno == ENOENT) return true;
    if (left < 0 && !isLink) failOn(path, "cannot write", errno);
    const bool isFree = isLink || tryLock(left, FileLock::exclusive) != LockOutcome::refused;
    // The lock may be one on a file that another process has replaced meanwhile.
    const bool isGone = !isLink && !isNamed(left, temporary);
    const int error = isFree && !isGone && ::unlink(temporary.c_str()) != 0 && errno != ENOENT ? errno : 0;
    if (left >= 0) ::close(left);
    if (error != 0) failOn(path, "cannot write", error);
    return isFree;
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
    if (std::filesystem::is_directory(path, error)) failOn(path, "cannot write", EISDIR);
    // Under a name of its own: another process may be writing this very file.
    std::string probe = (folder / ".taut-probe-XXXXXX").string();
    const int descriptor = ::mkstemp(probe.data());
    if (descriptor < 0) failOn(path, "cannot write", errno);
    ::unlink(probe.c_str());
    ::close(descriptor);
}

WholeFile::WholeFile(std::filesystem::path path, std::chrono::milliseconds patience)
    : path_(std::move(path)), temporary_(temporaryName(path_)) {
    if (std::error_code error; std::filesystem::is_directory(path_, error)) failOn(path_, "cannot write", EISDIR);
    const auto end = std::chrono::steady_clock::now() + patience;
    // Over again when another process has made or taken away that name between two calls.
    while (descriptor_ < 0) {
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (descriptor_ < 0) {
            if (errno != EEXIST) failOn(path_, "cannot write", errno);
            if (hasRemovedLeftOver(path_, temporary_)) continue;
            if (std::chrono::steady_clock::now() >= end)
                throw Error(ErrorKind::inputOutput, path_.string() + ": another process is writing this file");
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        } else if (tryLock(descriptor_, FileLock::exclusive) == LockOutcome::refused ||
                   !isNamed(descriptor_, temporary_)) {
            ::close(descriptor_);
            descriptor_ = -1;
        }
    }
}

WholeFile::~WholeFile() {
    remove();
}

// While it is locked, so that it is not another's that goes.
void WholeFile::remove() {
    if (descriptor_ < 0) return;
    ::unlink(temporary_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
}

void WholeFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail("cannot write", errno);
        bytes = bytes.subspan(done);
    }
}

void WholeFile::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void WholeFile::commit() {
    // Some file systems report a full disk only when a descriptor is closed. The lock goes with the last one.
    if (const int copy = ::dup(descriptor_); copy >= 0 && ::close(copy) != 0) fail("cannot write", errno);
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot rename the finished file", errno);
    ::close(descriptor_);
    descriptor_ = -1;
}

void WholeFile::fail(const char* what, int error) {
    remove();
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

namespace {

// A file that is read to its end, once, and closed then.
class OpenFile {
  public:
    OpenFile(const std::filesystem::path& path, std::chrono::milliseconds patience)
        : path_(path),
          patience_(static_cast<int>(patience.count())),
          file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
        if (file_.get() < 0) failOn(path_, "cannot read", errno);
    }

    struct stat facts() const {
        struct stat facts = {};
        if (::fstat(file_.get(), &facts) != 0) failOn(path_, "cannot read", errno);
        return facts;
    }

    // Of a pipe, also for the first to write.
    void waitForMore() const {
        pollfd more{file_.get(), POLLIN, 0};
        if (::poll(&more, 1, patience_) == 0) failOn(path_, "cannot read", ETIMEDOUT);
    }

    // How many bytes came; 0: there are no more.
    std::size_t read(std::span<char> buffer) const {
        for (;;) {
            const ssize_t got = ::read(file_.get(), buffer.data(), buffer.size());
            if (got >= 0) return static_cast<std::size_t>(got);
            if (errno == EAGAIN)
                waitForMore();
            else if (errno != EINTR)
                failOn(path_, "cannot read", errno);
        }
    }

  private:
    const std::filesystem::path& path_;
    int patience_;  // [ms]
    FileDescriptor file_;
};

}  // namespace

std::string fileContent(const std::filesystem::path& path, std::uint64_t maxBytes, std::chrono::milliseconds patience) {
    const OpenFile file(path, patience);
    const struct stat facts = file.facts();
    if (S_ISDIR(facts.st_mode)) failOn(path, "cannot read", EISDIR);
    if (S_ISFIFO(facts.st_mode)) file.waitForMore();
    if (!S_ISREG(facts.st_mode) && !S_ISFIFO(facts.st_mode))
        throw Error(ErrorKind::inputOutput, path.string() + ": cannot read: this is a device, not a file");
    const auto tooLarge = [&] {
        const std::uint64_t mebibytes = maxBytes >> 20U;
        throw Error(ErrorKind::badContent,
                    path.string() + ": the file is larger than " +
                        (mebibytes > 0 ? std::to_string(mebibytes) + " MiB" : std::to_string(maxBytes) + " bytes"));
    };
    if (facts.st_size > 0 && static_cast<std::uint64_t>(facts.st_size) > maxBytes) tooLarge();
    std::string content;
    content.reserve(facts.st_size);
    char buffer[1 << 16];
    // Counted all the same: the size of a pipe, and of files of the kernel, is reported as 0.
    while (const std::size_t got = file.read(buffer)) {
        content.append(buffer, got);
        if (content.size() > maxBytes) tooLarge();
    }
    return content;
}

}  // namespace taut::core
