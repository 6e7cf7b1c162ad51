// When an island changes its step: the substeps a tick that follow what the bound of the state asks for.
//
// A step that follows the state is not symplectic: switching back and forth between two steps takes energy out or puts
// some in. So it is shortened at once where the bound asks for it, and lengthened only when the bound has allowed a
// step longer by 15 % for a second. The bound is taken at a tick's end; where the step was over it the tick is undone
// and repeated in shorter steps.
#pragma once

#include <algorithm>
#include <cmath>

namespace taut::world {

inline constexpr int mostSubsteps = 1'000'000;  // a tick

class StepFollowing {
  public:
    StepFollowing() = default;
    // need: substeps a tick, a real number, at the share `safety` of the longest stable step; patience: ticks a second.
    StepFollowing(double need, double safety, int patience)
        : substeps_(enough(need)), patience_(patience), slack_(safety < 1.0 ? 2.0 * safety / (1.0 + safety) : 1.0) {}

    int substeps() const { return substeps_; }

    // Whether steps that long went beyond half of what safety leaves of the limit.
    bool isExceededBy(double need) const { return need * slack_ > substeps_; }
    void shorten(double need) {
        substeps_ = std::max(enough(need), substeps_ + 1);
        startAnew();
    }
    // After a tick that stood.
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
    // What a checkpoint holds of it.
    template <class Visit>
    void visit(Visit&& each) {
        each(substeps_);
        each(calmTicks_);
        each(most_);
    }

  private:
    // A hair less, so that a step of exactly a tick's part is not cut once more.
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
    double most_ = 0;  // need of the calm ticks
    double slack_ = 1;
};

}  // namespace taut::world
