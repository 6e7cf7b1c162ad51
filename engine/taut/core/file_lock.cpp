#include "taut/core/private/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace taut::core {

LockOutcome tryLock(int descriptor, FileLock lock) {
    struct flock range = {};  // all of it
    range.l_type = lock == FileLock::exclusive ? F_WRLCK : F_RDLCK;
    range.l_whence = SEEK_SET;
    while (::fcntl(descriptor, F_OFD_SETLK, &range) != 0) {
        if (errno == EINTR) continue;
        return errno == EAGAIN || errno == EACCES ? LockOutcome::refused : LockOutcome::unknown;
    }
    return LockOutcome::taken;
}

bool isNamed(int descriptor, const std::filesystem::path& path) {
    struct stat open = {}, named = {};
    return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

}  // namespace taut::core
