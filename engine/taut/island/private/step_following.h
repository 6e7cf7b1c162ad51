// When an island changes its step. It knows no island and no bound: it counts the substeps a tick that a bound asks
// for.
//
// Why the step follows the state. The fastest frequency of a network depends on its shape. The bound that holds in any
// shape (B1 of mechanics/stability.h) is larger than the bound of the present shape (B2), so steps made from B1 are
// shorter than most states need.
//
// Why it changes seldom. A symplectic method with one step h keeps an energy that differs from the true one by O(h^p).
// That energy depends on h (Hairer, Lubich and Wanner, Geometric Numerical Integration, chapter IX). Each change of h
// moves the motion to another one, and many changes back and forth add up to a drift (Calvo and Sanz-Serna 1993). So
// the rule has hysteresis:
//
//   share of the stability limit        0 ......... s/1.15 ........ s ........ (1+s)/2 ........ 1
//                                         lengthen after 1 s   keep   target   keep       shorten now
//
// - A tick is taken in equal steps. The need is computed from the state at its end.
// - Shorten: beyond the share (1 + s)/2 the tick is undone and repeated with as many substeps as the need asks for. So
// no tick stands that was taken beyond that share. Each repetition adds at least one substep, and the number of
// substeps is bounded, so repetitions end.
// - Lengthen: only after a second of ticks, each of which would have allowed steps longer by 15 %. The largest need of
// that second counts. A tick that would not have allowed it restarts the second.
//
// Why replay and resume agree. The decision is a function of the state at the end of ticks and of the three numbers
// that visit() saves. No clock enters it, and the bound has the same bits for any number of threads. A repeated try
// leaves nothing behind but the new number of substeps, and a checkpoint lies between two ticks.
#pragma once

#include <algorithm>
#include <cmath>

namespace taut::world {

inline constexpr int mostSubsteps = 1'000'000;  // a tick

class StepFollowing {
  public:
    StepFollowing() = default;
    // need: substeps a tick, a real number, at the share `safety` of the longest stable step. patience: ticks in a
    // second.
    StepFollowing(double need, double safety, int patience)
        : substeps_(enough(need)), patience_(patience), slack_(safety < 1.0 ? 2.0 * safety / (1.0 + safety) : 1.0) {}

    int substeps() const { return substeps_; }

    // Whether the steps taken went beyond half of the margin that `safety` leaves to the limit.
    bool isExceededBy(double need) const { return need * slack_ > substeps_; }
    void shorten(double need) {
        substeps_ = std::max(enough(need), substeps_ + 1);
        startAnew();
    }
    // To be called after a tick that stands.
    void lengthenIfCalm(double need) {
        constexpr double worthwhile = 1.15;
        most_ = std::max(most_, need);
        if (worthwhile * enough(most_) > substeps_) return startAnew();
        if (++calmTicks_ < patience_) return;
        substeps_ = enough(most_);
        startAnew();
    }

    bool isSound() const {
        return substeps_ > 0 && substeps_ <= mostSubsteps && most_ <= mostSubsteps && calmTicks_ >= 0 &&
               calmTicks_ <= patience_ && most_ >= 0;
    }
    // Visits the members that a checkpoint saves.
    template <class Visit>
    void visit(Visit&& each) {
        each(substeps_);
        each(calmTicks_);
        each(most_);
    }

  private:
    // Rounds up with a small tolerance, so that a step of exactly a tick's part is not divided once more.
    static int enough(double need) {
        const double steps = std::ceil(need * (1 - 1e-12));
        return steps < mostSubsteps ? std::max(1, static_cast<int>(steps)) : mostSubsteps;
    }
    void startAnew() {
        calmTicks_ = 0;
        most_ = 0;
    }

    int substeps_ = 1;
    int patience_ = 60;
    int calmTicks_ = 0;
    double most_ = 0;  // largest need of the calm ticks
    double slack_ = 1;
};

}  // namespace taut::world
