// Impulses that hold points of rigid bodies together.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "taut/island/private/joined_bodies.h"

namespace taut::test {
namespace {

using glm::dvec3;

// Two bodies of 1 kg, each with two pins on an axle. Those of the one are `off` further apart and aslant by so many
// radians: no motion makes up for the distance. Six rows would have a response along the axle of the square of the
// slant, and impulses that go after it would move the bodies by off / slant². They move by some times the offset of the
// pins and no more.
TEST(JoinedBodies, DoNotAskInVainForWhatTwoPinsAlongAnAxleCannotGive) {
    for (const auto& [off, slant] : std::vector<std::pair<double, double>>{
             {1e-9, 0.0}, {1e-9, 1e-5}, {1e-9, 3e-4}, {1e-5, 1e-3}, {1e-5, 1e-2}, {1e-4, 0.1}}) {
        constexpr double half = 0.01;
        std::vector<dvec3> x;
        world::JoinedBodies joined;
        joined.begin(16);
        for (const bool isOther : {false, true}) {
            const dvec3 centre(0.0, 0.0, isOther ? 0.03 : 0.0);
            std::vector<dvec3> own;
            for (const double side : {-0.04, 0.04})
                for (int k = 0; k < 3; ++k) {
                    dvec3 arm(0.0);
                    arm[k] = side;
                    own.push_back(centre + arm);
                }
            for (const double side : {-1.0, 1.0})
                own.push_back(isOther ? dvec3(side * half * slant, 0.0, side * (half + 0.5 * off))
                                      : dvec3(0.0, 0.0, side * half));
            const std::vector<double> masses(own.size(), 1.0 / 8);
            std::vector<std::size_t> numbers(own.size());
            std::iota(numbers.begin(), numbers.end(), x.size());
            joined.addBody(core::rigidMotionOf(masses, own, own), numbers);
            x.insert(x.end(), own.begin(), own.end());
        }
        for (const int pin : {6, 7}) joined.addPair({pin, pin + 8, 0, 0.0, false});
        const std::vector<double> inverseMass(x.size(), 8.0);
        ASSERT_TRUE(joined.solve(x, inverseMass, x, true, 1e-12));
        for (const dvec3& impulse : joined.impulses())
            EXPECT_LT(glm::length(impulse), 10 * (off + half * slant)) << slant;  // [kg m] of 1 kg
    }
}

}  // namespace
}  // namespace taut::test
