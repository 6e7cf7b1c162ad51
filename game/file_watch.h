// Files that somebody may write while the program runs. It reads none of them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::game {

class FileWatch {
  public:
    // From now on these, each once; a folder changes when a file in it comes, goes or is replaced. Those that were
    // watched before are still compared with what they were when last told of.
    void watch(std::vector<std::string> files);

    // Whether one of them is another than when this was last true, or watch() was called: once it has stayed so from
    // one look to the next, so that a file is not read while it is written. Looks at most every `pause`.
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
    std::vector<Stamp> known_, last_;  // (files) when last told of, when last looked at
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace taut::game
