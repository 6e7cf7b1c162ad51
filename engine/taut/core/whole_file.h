// Files that are complete or absent: written under a temporary name and renamed at the end. Independent of their
// contents.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace taut::core {

// The name that a file has while it is being written: its own with ".part" behind it, in the same folder.
std::filesystem::path temporaryName(const std::filesystem::path& path);

// Makes the folder that the file is to lie in and tries that a file can be made there, so that a run that could not
// keep its results fails before it begins. Throws core::Error(inputOutput); leaves no file behind.
void prepareFolderOf(const std::filesystem::path& path);

// A file being written, by one process at a time: the second throws. Without commit() nothing stays of it, and a file
// of that name from before is untouched.
class WholeFile {
  public:
    // Creates the temporary file, replacing one of a killed process; waits at most this long for another process that
    // is writing it. Throws core::Error(inputOutput).
    explicit WholeFile(std::filesystem::path path, std::chrono::milliseconds patience = {});
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    // Appends; throws core::Error(inputOutput), a full disk included.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    // Where it is until then: another program may write it.
    const std::filesystem::path& temporary() const { return temporary_; }

    // Closes the file and gives it its name; throws core::Error(inputOutput).
    void commit();

  private:
    void remove();
    [[noreturn]] void fail(const char* what, int error);

    std::filesystem::path path_;
    std::filesystem::path temporary_;
    int descriptor_ = -1;
};

// The whole of a file in one call; throws core::Error(inputOutput).
void writeWholeFile(const std::filesystem::path& path, std::string_view content);

// Whether there is anything of that name; false where that cannot be known.
bool isThere(const std::filesystem::path& path);

// Content of a file or a pipe. Throws core::Error: inputOutput if it is missing, unreadable, a folder or a device, or
// if nothing arrives within `patience`; badContent for more than maxBytes, before it reads more.
inline constexpr std::uint64_t mostText = std::uint64_t{16} << 20U;  // [bytes] more is no text that people wrote
std::string fileContent(const std::filesystem::path& path, std::uint64_t maxBytes = mostText,
                        std::chrono::milliseconds patience = std::chrono::seconds(10));

}  // namespace taut::core
