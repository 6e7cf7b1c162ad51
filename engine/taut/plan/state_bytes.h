// Writes and reads the bytes of a world by the same code: a struct lists its saved members once, in order. It knows no
// struct of the world.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/core/bytes.h"
#include "taut/mechanics/linear_path.h"

namespace taut::world {

[[noreturn]] inline void misfit(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "the bytes are not of this scene: " + what);
}

// Writing changes nothing. Reading throws core::Error(badContent) for bytes that end too early or hold impossible
// values, such as an infinite number or an unknown enumerator.
class StateBytes {
  public:
    explicit StateBytes(core::ByteWriter& writer) : writer_(&writer) {}
    explicit StateBytes(core::ByteReader& reader) : reader_(&reader) {}

    bool isReading() const { return reader_ != nullptr; }
    // Checks a condition on the values read. Does nothing while writing.
    void require(bool condition) const {
        if (isReading() && !condition) core::ByteReader::fail();
    }

    // Writes the mark if wanted; reads it if present. Returns whether it is there.
    bool mark(std::uint64_t mark, bool isWanted) {
        if (!isReading()) {
            if (isWanted) writer_->add(mark);
            return isWanted;
        }
        core::ByteReader ahead = *reader_;
        if (ahead.number<std::uint64_t>() != mark) return false;
        *reader_ = ahead;
        return true;
    }

    template <class Number>
    requires std::is_arithmetic_v<Number>
    void operator()(Number& number) {
        raw(number);
        if constexpr (std::is_floating_point_v<Number>) require(std::isfinite(number));
    }
    // Any number, also infinite or NaN: for the state of a run that diverged.
    template <class Number>
    void raw(Number& number) {
        if (isReading())
            number = reader_->number<Number>();
        else
            writer_->add(number);
    }
    void notNegative(double& number) {
        (*this)(number);
        require(number >= 0);
    }
    void atLeast(std::int64_t& number, std::int64_t least, std::int64_t most) {
        (*this)(number);
        require(number >= least && number <= most);
    }
    // Enumerators 0 … last.
    template <class Enum>
    void choice(Enum& value, Enum last) {
        int number = static_cast<int>(value);
        (*this)(number);
        require(number >= 0 && number <= static_cast<int>(last));
        value = static_cast<Enum>(number);
    }
    void operator()(std::string& text) {
        if (isReading())
            text = reader_->text();
        else
            writer_->add(text);
    }
    // Reading expects exactly this value.
    void expect(std::string text, const char* why) {
        const std::string expected = text;
        (*this)(text);
        if (text != expected) misfit(why);
    }
    void operator()(glm::dvec3& v) {
        for (int p = 0; p < 3; ++p) (*this)(v[p]);
    }
    template <class Value>
    void operator()(mechanics::LinearPathOf<Value>& path) {
        (*this)(path.from);
        (*this)(path.to);
        (*this)(path.t0);
        (*this)(path.t1);
        (*this)(path.isLine);
    }
    void operator()(glm::dquat& rotation) {
        for (double* number : {&rotation.w, &rotation.x, &rotation.y, &rotation.z}) (*this)(*number);
        const double length2 = glm::dot(rotation, rotation);
        require(length2 > 0.25 && length2 < 4.0);
    }
    void operator()(collision::Pose& pose) {
        (*this)(pose.position);
        (*this)(pose.rotation);
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
    // Structs, each by visit(bytes, item).
    template <class Item, class Visit>
    void each(std::vector<Item>& items, Visit visit) {
        auto count = static_cast<std::uint64_t>(items.size());
        (*this)(count);
        if (isReading()) items.clear();
        for (std::uint64_t i = 0; i < count; ++i) {
            if (isReading()) items.emplace_back();
            visit(items[i]);
        }
    }
    template <class Item, class Visit>
    void optional(std::optional<Item>& item, Visit visit) {
        bool has = item.has_value();
        (*this)(has);
        if (isReading()) item = has ? std::optional<Item>(Item{}) : std::nullopt;
        if (has) visit(*item);
    }

  private:
    core::ByteWriter* writer_ = nullptr;
    core::ByteReader* reader_ = nullptr;
};

}  // namespace taut::world
