#include "taut/live/adaptation.h"

#include <algorithm>
#include <utility>

#include "taut/core/error.h"

namespace taut::live {
namespace {

constexpr int starting = 12, settling = 3;  // turns at the start and after a change, in which things are made ready
constexpr double longestStart = 0.5;        // [s] of them
constexpr std::size_t fewest = 4;           // turns for a judgement
constexpr double window = 0.25;             // [s] at least, for a judgement
constexpr double leastShare = 0.3;          // of a turn, for which a picture counts as its reason
constexpr double muchTooLong = 1.5;         // of the goal: two levels at once
constexpr double spare = 0.85;              // of the goal, for which a level up is expected to do
constexpr double firstPatience = 1.5, mostPatience = 60.0;  // [s]
constexpr double regret = 8.0;                              // [s] a rise that is taken back within that was a mistake

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

Adaptation::Adaptation(std::vector<double> costs, int level, double goal)
    : costs_(std::move(costs)), level_(level), goal_(goal), unsettled_(starting), patience_(firstPatience) {
    TAUT_EXPECTS(!costs_.empty() && level >= 0 && level < static_cast<int>(costs_.size()) && goal > 0.0);
    TAUT_EXPECTS(costs_.front() > 0.0 && std::is_sorted(costs_.begin(), costs_.end()));
}

bool Adaptation::add(double drawing, double turn) {
    sinceRise_ += turn;
    if (unsettled_ > 0) {
        --unsettled_;
        spent_ += turn;
        if (spent_ > longestStart) unsettled_ = 0;
        if (unsettled_ == 0) spent_ = 0.0;
        return false;
    }
    drawings_.push_back(drawing);
    turns_.push_back(turn);
    spent_ += turn;
    if (drawings_.size() < fewest || spent_ < window) return false;
    const bool isChanged = judge();
    drawings_.clear();
    turns_.clear();
    spent_ = 0.0;
    return isChanged;
}

// By the medians: a single turn that the machine held up says nothing.
bool Adaptation::judge() {
    const double drawing = median(drawings_), turn = median(turns_);
    if (turn > goal_) {
        atEase_ = 0.0;
        if (level_ == 0 || drawing < leastShare * turn) return false;
        const int lower = std::max(0, level_ - (turn > muchTooLong * goal_ ? 2 : 1));
        wasRegretted_ = sinceRise_ < regret;
        if (wasRegretted_) patience_ = std::min(2.0 * patience_, mostPatience);
        change(lower);
        return true;
    }
    const bool isTop = level_ + 1 == static_cast<int>(costs_.size());
    const double more = isTop ? 1.0 : costs_[static_cast<std::size_t>(level_) + 1] / costs_[level_];
    if (isTop || std::max(turn, more * drawing) > spare * goal_) {
        atEase_ = 0.0;
        return false;
    }
    atEase_ += spent_;
    if (atEase_ < patience_) return false;
    if (!std::exchange(wasRegretted_, false)) patience_ = firstPatience;
    sinceRise_ = 0.0;
    change(level_ + 1);
    return true;
}

void Adaptation::change(int level) {
    level_ = level;
    atEase_ = 0.0;
    unsettled_ = settling;
}

}  // namespace taut::live
