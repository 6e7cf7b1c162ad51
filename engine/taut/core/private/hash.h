// Numbers from numbers. The state hash: FNV-1a with 64 bits, fed number by number in a fixed order. Negative zero
// counts as zero. A number at a time instead of a byte at a time costs an eighth; the fold makes up for the bits that a
// multiplication only carries upwards.
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
    void add(std::uint64_t word) { addNumber(word); }
    void add(float x) { addNumber(std::bit_cast<std::uint32_t>(x == 0.0F ? 0.0F : x)); }
    void add(double x) { addNumber(std::bit_cast<std::uint64_t>(x == 0.0 ? 0.0 : x)); }
    std::uint64_t value() const { return value_; }

  private:
    void addNumber(std::uint64_t bits) {
        value_ = (value_ ^ bits) * 0x100000001b3ULL;
        value_ ^= value_ >> 32;
    }
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

// All bits of a number spread over all of another: SplitMix64 (Steele, Lea and Flood 2014) over a counter.
inline std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

}  // namespace taut::core
