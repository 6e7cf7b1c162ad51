// Whether the points of an island have come to rest, from where they were at the ends of ticks. It knows no forces,
// no contact and no island.
//
// Time is cut into windows, the same for all islands. The first tick end of a window keeps all places, that in its
// middle does so again. An island is calm if no point is ever further than a third of the error from its first place.
//
//     tick end   0                      n/2                      n      calm: all within error / 3 of x0
//     kept       x0                     xm                       x1     v = (x1 - x0) / T
//                                                                       a = (x1 - 2 xm + x0) / (T/2)²
//
// v and a are means over half a second. A faster jitter has little of either, but then its entire amplitude is seen.
// Stored velocities would not do: those of pressed points contain half a kick of the forces.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace taut::world {

using glm::dvec3;

// Ticks of a window: even, about half a second.
inline std::int64_t restWindow(double ticksPerSecond) {
    return 2 * std::max<std::int64_t>(2, static_cast<std::int64_t>(0.25 * ticksPerSecond + 0.5));
}

class RestWatch {
  public:
    // Begins window `number` at places x (points) [m], or lets it pass.
    void begin(std::int64_t number, std::span<const dvec3> x) {
        stop();
        if (number % every_ == 0) first_.assign(x.begin(), x.end());
    }
    // At the end of a tick within the window, and once more at its end.
    void look(std::span<const dvec3> x, double most, bool isMiddle) {
        for (std::size_t i = 0; i < first_.size(); ++i) {
            const dvec3 way = x[i] - first_[i];
            if (!(glm::dot(way, way) <= most * most)) return stop();
        }
        if (isMiddle && isWatching()) middle_.assign(x.begin(), x.end());
    }
    // Until the next window begins.
    void stop() { first_.clear(), middle_.clear(); }
    bool isWatching() const { return !first_.empty(); }
    // Whether it has seen the whole window, and all were calm.
    bool isCalm() const { return isWatching() && !middle_.empty(); }

    // A calm island could not fall asleep, and the test was expensive: it watches every second window, every fourth ...
    // By their numbers, so that islands that touch watch the same ones.
    void fail() { every_ = std::min(2 * every_, seldom); }
    void forgive() { every_ = 1; }

    // Over the window that ends at x, `seconds` [s] long: velocity [m/s] and acceleration [m/s²] of a point.
    dvec3 velocity(std::size_t i, const dvec3& x, double seconds) const { return (x - first_[i]) / seconds; }
    dvec3 acceleration(std::size_t i, const dvec3& x, double seconds) const {
        return (x - 2.0 * middle_[i] + first_[i]) / (0.25 * seconds * seconds);
    }

    // [m] How far any point still goes from x, where a window ends, if all motion goes on to shrink from one half of a
    // window to the next as it did in this one; infinite if it did not, or was more than `most` in one.
    double wayLeft(std::span<const dvec3> x, double most) const {
        double before = 0, after = 0;
        for (std::size_t i = 0; i < first_.size(); ++i) {
            before = std::max(before, glm::distance(first_[i], middle_[i]));
            after = std::max(after, glm::distance(middle_[i], x[i]));
        }
        if (after == 0) return 0;
        return after < before && before <= most ? after * after / (before - after) : HUGE_VAL;
    }

    template <class Bytes>
    void visit(Bytes& bytes, std::size_t pointCount) {
        bytes.list(first_);
        bytes.list(middle_);
        bytes(every_);
        const auto fits = [&](const auto& places) { return places.empty() || places.size() == pointCount; };
        bytes.require(fits(first_) && fits(middle_) && every_ >= 1 && every_ <= seldom);
    }

  private:
    static constexpr int seldom = 16;

    std::vector<dvec3> first_, middle_;  // (points) [m]; empty: not calm, or not there yet
    int every_ = 1;                      // of these windows one is watched
};

}  // namespace taut::world
