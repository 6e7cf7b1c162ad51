// Points that contacts hold up while an implicit step is solved again: which numbers are given, and the subspace that
// is left for the solve (the filter of Baraff and Witkin).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "taut/core/aligned_array.h"
#include "taut/ode/method.h"

namespace taut::ode {

template <class Real>
class Supports {
  public:
    enum class Hold : char { none, along, fully };

    void resize(Layout layout) {
        layout_ = layout;
        holds_.assign(layout.count, Hold::none);
        rubbed_ = core::AlignedArray<Real>(layout.size());
    }

    // Takes the supports of a solve. x (layout.size()): where the contacts have put the points.
    void take(std::span<Support> supports, const Real* x) {
        all_ = supports;
        x_ = x;
        std::fill(rubbed_.begin(), rubbed_.end(), Real(0));
        for (Support& support : all_) {
            const bool slides =
                std::any_of(support.normal.begin(), support.normal.end(), [](double n) { return n != 0; });
            holds_[index(support)] = slides ? Hold::along : Hold::fully;
            std::size_t p = 0;
            if (slides)
                forEachPlane(support,
                             [&](std::size_t at, double) { rubbed_[at] = static_cast<Real>(support.rub[p++]); });
            support.impulse = 0;
        }
    }
    void release() {
        for (const Support& support : all_) holds_[index(support)] = Hold::none;
        std::fill(rubbed_.begin(), rubbed_.end(), Real(0));
        all_ = {};
    }

    bool empty() const { return all_.empty(); }
    Hold holdOf(std::size_t point) const { return holds_[point]; }
    bool isFree(std::size_t point) const { return holds_[point] != Hold::fully; }
    Real given(std::size_t at) const { return x_[at]; }
    const Real* given() const { return x_; }
    Real rubbed(std::size_t at) const { return rubbed_[at]; }  // change of v by friction
    std::span<Support> all() const { return all_; }

    // Calls f(support) for the points held along their normals.
    template <class F>
    void forEachAlong(F&& f) const {
        for (Support& support : all_)
            if (holds_[index(support)] == Hold::along) f(support);
    }
    // Calls f(index in the array, component of the normal) for each plane.
    template <class F>
    void forEachPlane(const Support& support, F&& f) const {
        for (int p = 0; p < layout_.planes; ++p)
            f(static_cast<std::size_t>(static_cast<std::ptrdiff_t>(p) * layout_.stride + support.point),
              support.normal[p]);
    }
    double along(const Support& support, const Real* rows) const {
        double sum = 0;
        forEachPlane(support, [&](std::size_t at, double n) { sum += n * static_cast<double>(rows[at]); });
        return sum;
    }
    void addAlong(const Support& support, double length, Real* rows) const {
        forEachPlane(
            support, [&](std::size_t at, double n) { rows[at] += static_cast<Real>(length * n); });
    }
    // Removes the part along the normal from the rows of points held along a normal.
    void flatten(Real* rows) const {
        forEachAlong([&](const Support& support) { addAlong(support, -along(support, rows), rows); });
    }
    // Gives all planes of such a point one number, so that a vector across its normal stays across it. inverse: of a
    // diagonal.
    void level(Real* inverse) const {
        forEachAlong([&](const Support& support) {
            double sum = 0;
            forEachPlane(
                support, [&](std::size_t at, double) { sum += 1.0 / static_cast<double>(inverse[at]); });
            forEachPlane(
                support, [&](std::size_t at, double) { inverse[at] = static_cast<Real>(layout_.planes / sum); });
        });
    }

    static std::size_t index(const Support& support) { return static_cast<std::size_t>(support.point); }

  private:
    Layout layout_{};
    std::vector<Hold> holds_;  // (points)
    std::span<Support> all_;
    const Real* x_ = nullptr;
    core::AlignedArray<Real> rubbed_;
};

}  // namespace taut::ode
