#include "game/file_watch.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace taut::game {

void FileWatch::watch(std::vector<std::string> files) {
    std::swap(files, files_);  // now the ones before
    const std::vector<Stamp> before = std::move(known_);
    known_ = last_ = look();
    for (std::size_t i = 0; i < files_.size(); ++i)
        if (const auto old = std::ranges::find(files, files_[i]); old != files.end())
            known_[i] = before[old - files.begin()];
}

bool FileWatch::hasChanged() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return false;
    next_ = now + pause;
    std::vector<Stamp> stamps = look();
    const bool isSettled = stamps == last_;
    last_ = std::move(stamps);
    if (!isSettled || last_ == known_) return false;
    known_ = last_;
    return true;
}

std::vector<FileWatch::Stamp> FileWatch::look() const {
    std::vector<Stamp> stamps;
    for (const std::string& file : files_) {
        std::error_code error;
        Stamp stamp;
        stamp.written = std::filesystem::last_write_time(file, error);
        stamp.isThere = !error;
        if (const std::uintmax_t size = std::filesystem::file_size(file, error); !error) stamp.size = size;
        if (!stamp.isThere) stamp = {};
        stamps.push_back(stamp);
    }
    return stamps;
}

}  // namespace taut::game
