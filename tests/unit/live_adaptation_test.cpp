#include "taut/live/adaptation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace taut::live {
namespace {

constexpr double goal = 1.0 / 30.0;
const std::vector<double> costs = {6.0, 9.0, 12.0, 16.0, 20.0, 28.0};

// A machine that takes that many milliseconds for a unit of cost, 15 % more or less from picture to picture, while the
// work beside the pictures takes `other` [s] of a turn.
struct Machine {
    Adaptation adaptation{costs, 4, goal};
    int turns = 0, changes = 0;

    double turn(double slowness, double other) {
        const double noise = 1.0 + 0.15 * std::sin(2.4 * ++turns);
        const double drawing = 1e-3 * slowness * noise * costs[adaptation.level()];
        const double whole = std::max(drawing, other);
        changes += adaptation.add(drawing, whole);
        return whole;
    }
    // Returns the longest turn of the last second.
    double run(double seconds, double slowness, double other = 0.005) {
        double longest = 0.0;
        for (double t = 0.0; t < seconds;) {
            const double now = turn(slowness, other);
            t += now;
            if (t > seconds - 1.0) longest = std::max(longest, now);
        }
        return longest;
    }
};

// A picture takes 45 ms at the start and 27 ms at the third level. There it stays, for the next would take 36 ms.
TEST(Adaptation, FindsWithinTwoSecondsWhatThereIsTimeForAndStays) {
    Machine machine;
    machine.run(2.0, 2.25);
    EXPECT_EQ(machine.adaptation.level(), 2);
    machine.changes = 0;
    EXPECT_LT(machine.run(120.0, 2.25), goal);
    EXPECT_EQ(machine.changes, 0);
    EXPECT_EQ(machine.adaptation.level(), 2);
}

TEST(Adaptation, GoesUpAgainWhereThereIsTime) {
    Machine machine;
    machine.run(2.0, 6.0);
    EXPECT_EQ(machine.adaptation.level(), 0);
    machine.run(12.0, 0.5);
    EXPECT_EQ(machine.adaptation.level(), 5);
}

// A level up looks possible, by its cost, but by its effect on the work beside it turns become too long.
TEST(Adaptation, RevertedLevelsAreTriedEverLessOften) {
    Machine machine;
    const auto other = [&] { return machine.adaptation.level() > 2 ? 0.036 : 0.02; };
    const auto changesIn = [&](double seconds) {
        machine.changes = 0;
        for (double t = 0.0; t < seconds;) t += machine.turn(1.3, other());
        return machine.changes;
    };
    const int first = changesIn(30.0), second = changesIn(30.0);
    (void)changesIn(60.0);
    const int last = changesIn(120.0);
    EXPECT_LE(first, 12);
    EXPECT_LT(second, first);
    EXPECT_LE(last, 4);  // a minute between rises, each taken back
}

TEST(Adaptation, DelaysByOtherWorkChangeNothing) {
    Machine machine;
    machine.run(10.0, 1.0, 0.08);  // pictures of 20 ms in turns of 80 ms
    EXPECT_EQ(machine.changes, 0);
}

}  // namespace
}  // namespace taut::live
