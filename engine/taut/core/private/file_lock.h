// Kernel locks on files: released with the process, however it ends, and effective between threads too. Independent of
// the contents of the files.
#pragma once

#include <filesystem>

namespace taut::core {

enum class FileLock { shared, exclusive };

enum class LockOutcome {
    taken,
    refused,  // another holds one that excludes it
    unknown,  // the file system knows no locks
};

// Locks the whole of an open file, or changes the lock that this descriptor holds into the other, at once and without
// waiting.
LockOutcome tryLock(int descriptor, FileLock lock);

// Whether the file that is open is still the one of that name; a symbolic link is not followed.
bool isNamed(int descriptor, const std::filesystem::path& path);

}  // namespace taut::core
