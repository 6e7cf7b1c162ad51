#include "taut/live/pace.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "taut/core/error.h"

namespace taut::live {

int Pace::due(double wall, double speed, int most) {
    TAUT_EXPECTS(wall >= 0.0 && speed >= 0.0 && most >= 0);
    waiting_ += wall * speed / tickSeconds_;
    const double whole = std::floor(waiting_);
    waiting_ -= whole;
    return static_cast<int>(std::min(whole + std::exchange(owed_, 0), static_cast<double>(most)));
}

void Pace::owe(int ticks) {
    constexpr int mostOwed = 4;
    owed_ = std::clamp(ticks, 0, mostOwed);
}

}  // namespace taut::live
