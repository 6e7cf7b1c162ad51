// The state hash: FNV-1a with 64 bits, fed with numbers in a fixed order. Negative zero counts as zero.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace taut::core {

class Hash {
  public:
    void addByte(std::uint8_t byte) { value_ = (value_ ^ byte) * 0x100000001b3ULL; }
    void add(std::string_view text) {
        for (char c : text) addByte(static_cast<std::uint8_t>(c));
        addByte(0);
    }
    void add(std::uint64_t word) {
        for (int shift = 0; shift < 64; shift += 8) addByte(static_cast<std::uint8_t>(word >> shift));
    }
    void add(float x) { addBits(std::bit_cast<std::uint32_t>(x == 0.0F ? 0.0F : x), 4); }
    void add(double x) { addBits(std::bit_cast<std::uint64_t>(x == 0.0 ? 0.0 : x), 8); }
    std::uint64_t value() const { return value_; }

  private:
    void addBits(std::uint64_t bits, int bytes) {
        for (int i = 0; i < bytes; ++i) addByte(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace taut::core
