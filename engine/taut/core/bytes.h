// Numbers and texts as bytes and back: little-endian, in the order of writing, the same on every machine. Independent
// of files and of the meaning of the numbers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "taut/core/error.h"

namespace taut::core {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

class ByteWriter {
  public:
    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void add(Number number) { append(&number, sizeof number); }
    void add(std::string_view text) {
        add(static_cast<std::uint64_t>(text.size()));
        append(text.data(), text.size());
    }
    // A list of numbers, or of plain structs of numbers that fill them without gaps: its length and its bytes.
    template <class Item>
    requires std::is_trivially_copyable_v<Item>
    void addList(std::span<const Item> items) {
        add(static_cast<std::uint64_t>(items.size()));
        append(items.data(), items.size_bytes());
    }
    // All that was written; nothing of it stays here.
    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(const void* data, std::size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), from, from + size);
    }
    std::vector<std::byte> bytes_;
};

// Reads the bytes of a ByteWriter. Every call throws Error(badContent) if the bytes end too early.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    template <class Number>
    requires std::is_arithmetic_v<Number> Number number() {
        if constexpr (std::is_same_v<Number, bool>) {
            return number<std::uint8_t>() != 0;
        } else {
            Number value;
            std::memcpy(&value, next(sizeof value).data(), sizeof value);
            return value;
        }
    }
    std::string text() {
        const std::span<const std::byte> part = next(length(1));
        return {reinterpret_cast<const char*>(part.data()), part.size()};
    }
    // Expects the type that addList() was given; a wrong one is noticed only where the length does not fit.
    template <class Item>
    std::vector<Item> list() {
        std::vector<Item> items(length(sizeof(Item)));
        const std::span<const std::byte> part = next(items.size() * sizeof(Item));
        if (!items.empty()) std::memcpy(items.data(), part.data(), part.size());
        return items;
    }
    bool isAtEnd() const { return bytes_.empty(); }
    [[noreturn]] static void fail() { throw Error(ErrorKind::badContent, "the bytes are truncated or damaged"); }

  private:
    // The length of a list whose items take so many bytes each: never more than there is.
    std::size_t length(std::size_t itemSize) {
        const auto count = number<std::uint64_t>();
        if (count > bytes_.size() / itemSize) fail();
        return static_cast<std::size_t>(count);
    }
    std::span<const std::byte> next(std::size_t size) {
        if (size > bytes_.size()) fail();
        const std::span<const std::byte> part = bytes_.first(size);
        bytes_ = bytes_.subspan(size);
        return part;
    }
    std::span<const std::byte> bytes_;
};

}  // namespace taut::core
