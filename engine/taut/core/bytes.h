// Numbers and texts as bytes and back: little-endian, in the order of writing, the same on every machine. A struct
// lists its members once for both. Independent of files and of the meaning of the numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
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

// Writes or reads by the same code. `bytes(a, b)` passes members: numbers, texts, lists of these, and structs for which
// there is a function visit(Bytes&, Struct&). Writing changes nothing. Reading throws Error(badContent) for bytes that
// end too early.
class Bytes {
  public:
    explicit Bytes(ByteWriter& writer) : writer_(&writer) {}
    explicit Bytes(ByteReader& reader) : reader_(&reader) {}

    bool isReading() const { return reader_ != nullptr; }
    // Nothing is left to read. False while writing.
    bool isAtEnd() const { return isReading() && reader_->isAtEnd(); }
    // Checks a condition on the values read. Does nothing while writing.
    void require(bool condition) const {
        if (isReading() && !condition) ByteReader::fail();
    }

    template <class... Members>
    void operator()(Members&... members) {
        (member(members), ...);
    }

    // Any number, also infinite or NaN.
    template <class Number>
    void raw(Number& number) {
        if (isReading())
            number = reader_->number<Number>();
        else
            writer_->add(number);
    }
    void text(std::string& text) {
        if (isReading())
            text = reader_->text();
        else
            writer_->add(text);
    }
    // Enumerators 0 … last.
    template <class Enum>
    void choice(Enum& value, Enum last) {
        int number = static_cast<int>(value);
        raw(number);
        require(number >= 0 && number <= static_cast<int>(last));
        value = static_cast<Enum>(number);
    }
    // Numbers, or plain structs of numbers without gaps; their values are not checked.
    template <class Item>
    requires std::is_trivially_copyable_v<Item>
    void list(std::vector<Item>& items) {
        if (isReading())
            items = reader_->list<Item>();
        else
            writer_->addList(std::span<const Item>(items));
    }
    // An array of fixed size.
    template <class Array>
    void planes(Array& array) {
        using Number = std::remove_cvref_t<decltype(*array.begin())>;
        if (!isReading()) return writer_->addList(std::span<const Number>(array));
        const std::vector<Number> read = reader_->list<Number>();
        require(read.size() == array.size());
        std::copy(read.begin(), read.end(), array.begin());
    }
    // Items that `visit` passes one by one. Does not reserve: with a wrong count the bytes end first.
    template <class Item, class Visit>
    void each(std::vector<Item>& items, Visit visit) {
        auto count = static_cast<std::uint64_t>(items.size());
        raw(count);
        if (isReading()) items.clear();
        for (std::uint64_t i = 0; i < count; ++i) {
            if (isReading()) items.emplace_back();
            visit(items[i]);
        }
    }
    template <class Item, class Visit>
    void optional(std::optional<Item>& item, Visit visit) {
        bool has = item.has_value();
        raw(has);
        if (isReading()) item = has ? std::optional<Item>(Item{}) : std::nullopt;
        if (has) visit(*item);
    }

  protected:
    ByteWriter* writer_ = nullptr;
    ByteReader* reader_ = nullptr;

  private:
    void member(std::string& own) { text(own); }
    template <class Item>
    void member(std::vector<Item>& items) {
        if constexpr (std::is_arithmetic_v<Item> || std::is_same_v<Item, std::byte>)
            list(items);
        else
            each(
                items, [this](Item& item) { member(item); });
    }
    template <class Item, std::size_t size>
    void member(std::array<Item, size>& items) {
        for (Item& item : items) member(item);
    }
    template <class Value>
    void member(Value& value) {
        if constexpr (std::is_arithmetic_v<Value>)
            raw(value);
        else
            visit(*this, value);
    }
};

template <class Value>
std::vector<std::byte> bytesOf(const Value& value) {
    ByteWriter writer;
    Bytes bytes(writer);
    bytes(const_cast<Value&>(value));  // writing changes nothing
    return writer.take();
}

// Throws Error(badContent) for bytes that are not those of such a value, or more.
template <class Value>
Value valueIn(std::span<const std::byte> content) {
    ByteReader reader(content);
    Bytes bytes(reader);
    Value value;
    bytes(value);
    if (!reader.isAtEnd()) ByteReader::fail();
    return value;
}

}  // namespace taut::core
