// Bytes as text of 64 letters (RFC 4648, section 4), piece by piece.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::core {

class Base64 {
  public:
    // Appends the letters of whole groups of three bytes; up to two bytes wait for the next piece.
    void append(std::string& text, std::span<const std::byte> bytes);

    // Appends the letters of the waiting bytes, padded.
    void finish(std::string& text);

  private:
    std::array<std::byte, 3> waiting_{};
    std::size_t count_ = 0;  // number of waiting bytes
};

std::string base64(std::span<const std::byte> bytes);

// Appends the bytes of such a text, padded or not. False for other letters and lengths, and then some are missing.
bool fromBase64(std::string_view text, std::vector<unsigned char>& bytes);

}  // namespace taut::core
