// Writes and reads the bytes of a world by the same code: a struct lists its saved members once, in order. It knows no
// struct of the world.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <string>
#include <type_traits>

#include "taut/collision/colliders.h"
#include "taut/core/bytes.h"
#include "taut/mechanics/linear_path.h"

namespace taut::world {

[[noreturn]] inline void misfit(const std::string& what) {
    throw core::Error(core::ErrorKind::badContent, "the bytes are not of this scene: " + what);
}

// Writing changes nothing. Reading throws core::Error(badContent) for bytes that end too early or hold impossible
// values, such as an infinite number or an unknown enumerator.
class StateBytes : public core::Bytes {
  public:
    using Bytes::Bytes;

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
    void notNegative(double& number) {
        (*this)(number);
        require(number >= 0);
    }
    void atLeast(std::int64_t& number, std::int64_t least, std::int64_t most) {
        (*this)(number);
        require(number >= least && number <= most);
    }
    void operator()(std::string& own) { text(own); }
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
};

}  // namespace taut::world
