// Keeps two runs from writing into one folder at the same time. Independent of their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace taut::pipeline {

struct RunParty {
    std::optional<std::uint64_t> key;  // parts of one run have the same key and may share a folder; none: no sharing
    std::string name;                  // for the message to another run: "taut render flag, process 4711"
};

// Locks a folder, or one part ("60-119") of the files of a run in it, until it is destroyed or its process ends, in any
// way. Meanwhile a file `.taut-lock` or `.taut-lock_60-119` lies in the folder. A file that a killed process left
// behind locks nothing.
class RunLock {
  public:
    RunLock() = default;  // holds nothing

    // Makes the folder. Throws core::Error(inputOutput): another run writes there, or the folder cannot be written.
    RunLock(const std::filesystem::path& folder, const RunParty& party, const std::string& part = {});

    RunLock(RunLock&& other) noexcept;
    RunLock& operator=(RunLock&& other) noexcept;
    ~RunLock();

    std::filesystem::path folder() const { return path_.parent_path(); }
    bool excludesOthers() const { return excludesOthers_; }  // false on a file system that knows no locks

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    bool hasMadeFolder_ = false;  // it is removed again if it is still empty
    bool excludesOthers_ = true;
};

}  // namespace taut::pipeline
