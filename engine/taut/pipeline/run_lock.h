// Keeps two runs from writing into one folder at the same time. Independent of their files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "taut/core/private/file_descriptor.h"

namespace taut::pipeline {

struct RunParty {
    std::optional<std::uint64_t> key;  // parts of one run have the same key and may share a folder; none: no sharing
    std::string name;                  // for the message to another run: "taut render flag, process 4711"
};

// The name of a command of this process: "taut render flag, process 4711 on host".
std::string partyName(const std::string& command);

// Locks a folder, or one part ("60-119") of the files of a run in it, until it is destroyed or its process ends, in any
// way. Meanwhile a file `.taut-lock` or `.taut-lock_60-119` lies in the folder. A file that a killed process left
// behind locks nothing.
class RunLock {
  public:
    RunLock() = default;  // holds nothing

    // Makes the folder. Throws core::Error(inputOutput): another run writes there, or the folder cannot be written.
    RunLock(const std::filesystem::path& folder, const RunParty& party, const std::string& part = {});

    std::filesystem::path folder() const { return held_ ? held_->path.parent_path() : std::filesystem::path(); }
    bool excludesOthers() const { return excludesOthers_; }  // false on a file system that knows no locks

  private:
    struct Held {
        core::FileDescriptor file;
        std::filesystem::path path;
        bool hasMadeFolder;  // it is removed again if it is still empty

        ~Held();
    };
    std::unique_ptr<Held> held_;
    bool excludesOthers_ = true;
};

}  // namespace taut::pipeline
