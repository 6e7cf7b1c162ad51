// Files that others may write while the program runs. It reads none of them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::game {

class FileWatch {
  public:
    // Watches these files from now on, each once. A folder changes when a file in it comes, goes or is replaced. Files
    // that were watched before are still compared with their last reported state.
    void watch(std::vector<std::string> files);

    // Whether one of them has changed since this last returned true, or since watch(). The change must have lasted from
    // one look to the next, so that no file is read while it is written. Looks at most every `pause`.
    bool hasChanged();

    static constexpr std::chrono::milliseconds pause{150};

  private:
    struct Stamp {
        std::filesystem::file_time_type written{};
        std::uintmax_t size = 0;  // [bytes] of a file
        bool isThere = false;
        bool operator==(const Stamp&) const = default;
    };
    std::vector<Stamp> look() const;

    std::vector<std::string> files_;
    std::vector<Stamp> known_, last_;  // (files) when last reported, when last looked at
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace taut::game
