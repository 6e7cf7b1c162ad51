// A temporary file for bytes that arrive in another order than that of the final file. Independent of their meaning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "taut/core/whole_file.h"

namespace taut::geometry {

class ScratchFile {
  public:
    struct Piece {
        std::uint64_t offset = 0, size = 0;  // [bytes]
    };

    // Beside the future file `path`; removed by the destructor. Throws core::Error(inputOutput).
    explicit ScratchFile(const std::filesystem::path& path);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    // Appends and tells where. Throws core::Error(inputOutput).
    Piece add(std::span<const std::byte> bytes);
    Piece add(std::string_view text) { return add(std::as_bytes(std::span(text.data(), text.size()))); }
    std::uint64_t size() const { return written_ + buffer_.size(); }

    // Gives the bytes of a piece, in blocks. Throws core::Error(inputOutput).
    void visit(Piece piece, const std::function<void(std::span<const std::byte>)>& take);

    // Appends a piece to a file. Throws core::Error(inputOutput).
    void copy(Piece piece, core::WholeFile& to);

  private:
    void flush();

    core::WholeFile file_;
    int reader_ = -1;
    std::uint64_t written_ = 0;
    std::vector<std::byte> buffer_, copied_;
};

}  // namespace taut::geometry
