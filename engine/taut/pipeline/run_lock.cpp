#include "taut/pipeline/run_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include "taut/core/error.h"
#include "taut/core/private/file_lock.h"
#include "taut/core/whole_file.h"

namespace taut::pipeline {
namespace {

[[noreturn]] void fail(const std::filesystem::path& folder, const std::string& what) {
    throw core::Error(core::ErrorKind::inputOutput, fmt::format("{}: {}", folder.string(), what));
}

// The key and the name of the run that holds the folder; longer ones are cut.
std::string contentOf(int descriptor) {
    char text[512];
    const ssize_t got = ::pread(descriptor, text, sizeof text, 0);
    return {text, got > 0 ? static_cast<std::size_t>(got) : 0};
}

bool write(int descriptor, std::string_view text) {
    return ::ftruncate(descriptor, 0) == 0 &&
           ::pwrite(descriptor, text.data(), text.size(), 0) == static_cast<ssize_t>(text.size());
}

// The first of a run locks for itself, says who it is, and then shares where it may. A part finds its key there, and
// shares too.
enum class Turn { taken, unlocked, again, refused };
Turn takeTurn(int descriptor, const std::filesystem::path& path, const RunParty& party) {
    const std::string key = fmt::format("{:016x} ", party.key.value_or(0));
    const core::LockOutcome outcome = core::tryLock(descriptor, core::FileLock::exclusive);
    const bool isFirst = outcome != core::LockOutcome::refused;
    if (!isFirst && !party.key) return Turn::refused;
    if (!isFirst && core::tryLock(descriptor, core::FileLock::shared) == core::LockOutcome::refused)
        return Turn::refused;
    if (!core::isNamed(descriptor, path)) return Turn::again;  // the last holder has taken the file away
    if (!isFirst) return contentOf(descriptor).starts_with(key) ? Turn::taken : Turn::refused;
    if (!write(descriptor, key + party.name))
        fail(path.parent_path(), fmt::format("cannot write: {}", std::strerror(errno)));
    if (party.key) core::tryLock(descriptor, core::FileLock::shared);
    return outcome == core::LockOutcome::taken ? Turn::taken : Turn::unlocked;
}

std::string nameIn(const std::string& content) {
    const std::size_t blank = content.find(' ');
    return blank == std::string::npos ? "unknown" : content.substr(blank + 1);
}

}  // namespace

std::string partyName(const std::string& command) {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    return fmt::format("{}, process {} on {}", command, ::getpid(), host);
}

RunLock::RunLock(const std::filesystem::path& folder, const RunParty& party, const std::string& part) {
    const std::filesystem::path path = folder / (part.empty() ? ".taut-lock" : ".taut-lock_" + part);
    const bool hasMadeFolder = !core::isThere(folder);
    core::prepareFolderOf(path);
    std::string other;
    // A part is refused for a moment while the first is saying who it is.
    for (int refusals = 0; refusals < 20;) {
        core::FileDescriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
        if (file.get() < 0) fail(folder, fmt::format("cannot make {}: {}", path.string(), std::strerror(errno)));
        const Turn turn = takeTurn(file.get(), path, party);
        if (turn == Turn::taken || turn == Turn::unlocked) {
            held_ = std::unique_ptr<Held>(new Held{std::move(file), path, hasMadeFolder});
            excludesOthers_ = turn == Turn::taken;
            return;
        }
        other = contentOf(file.get());
        if (turn == Turn::again) continue;
        ++refusals;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (!part.empty())
        fail(folder, fmt::format("{} is being written by another process ({}); wait for its end", part, nameIn(other)));
    fail(folder, fmt::format("another run is writing here ({}); wait for its end, or give this one a folder of its own",
                             nameIn(other)));
}

RunLock::Held::~Held() {
    // The last one takes the file away: who has opened it meanwhile sees that it is no longer the one of that name.
    if (core::tryLock(file.get(), core::FileLock::exclusive) != core::LockOutcome::refused &&
        core::isNamed(file.get(), path))
        ::unlink(path.c_str());
    if (hasMadeFolder) ::rmdir(path.parent_path().c_str());  // refused where there is something
}

}  // namespace taut::pipeline
