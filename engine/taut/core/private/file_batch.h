// Changes several files of a folder together: all or none, even if the process is killed or the disk is full.
// Independent of their contents.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace taut::core {

// New files are written beside the old ones. Then a list of files to rename and remove is published under its name:
// from that moment the batch is final, and recover() completes it at any later time.
class FileBatch {
  public:
    explicit FileBatch(std::filesystem::path folder);
    ~FileBatch();  // without commit() nothing has changed
    FileBatch(const FileBatch&) = delete;
    FileBatch& operator=(const FileBatch&) = delete;

    // Where to write the new content of a file of the folder or of one below it; makes the folder that it lies in.
    // Throws core::Error(inputOutput).
    std::filesystem::path replace(const std::filesystem::path& file);

    // A file that is to go; it may be missing.
    void remove(const std::filesystem::path& file);

    // Throws core::Error(inputOutput); whether the batch is done then, recover() finds out.
    void commit();

    // Whether a process that was killed has left something to finish.
    static bool isPending(const std::filesystem::path& folder);

    // Finishes it. Throws core::Error: inputOutput, badContent for a list that names files elsewhere, links resolved.
    static void recover(const std::filesystem::path& folder);

  private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> replaced_, removed_;  // below the folder
    bool isListed_ = false;
};

}  // namespace taut::core
