// Irregular networks for the tests of springs, and small helpers they share.
#pragma once

#include <random>
#include <vector>

#include "taut/core/private/instruction_set.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/mechanics/model.h"

namespace taut::mechanics::test {

struct RandomNet {
    std::vector<glm::dvec3> positions, velocities;
    std::vector<double> masses;
    std::vector<Spring> springs;
};

// Three of four springs are strung along regular stretches, some with gaps; the others join any two points at most
// `reach` apart in number. Stiffness, length and damping vary; a quarter has no dashpot.
inline RandomNet randomNet(int points, int springs, int reach, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
    const auto whole = [&](int low, int high) { return std::uniform_int_distribution<>(low, high)(random); };
    RandomNet net;
    for (int i = 0; i < points; ++i) {
        net.positions.emplace_back(number(-1, 1), number(-1, 1), number(-1, 1));
        net.velocities.emplace_back(number(-1, 1), number(-1, 1), number(-1, 1));
        net.masses.push_back(number(0.1, 2.0));
    }
    while (static_cast<int>(net.springs.size()) < springs) {
        Spring s{0, 0, 0.0, number(0.0, 0.5), whole(0, 3) == 0 ? 0.0 : number(0.0, 0.01), SpringKind::structural};
        const int offset = whole(1, reach);
        const bool isStretch = whole(0, 9) == 0;
        const int count = isStretch ? whole(8, 300) : 1;
        s.a = whole(0, points - 1 - offset);
        for (int i = 0; i < count && s.a + offset < points; ++i, ++s.a) {
            if (isStretch && whole(0, 20) == 0) continue;
            s.b = s.a + offset;
            s.stiffness = number(1.0, 100.0);
            net.springs.push_back(s);
            if (whole(0, 1) == 0) std::swap(net.springs.back().a, net.springs.back().b);
        }
    }
    return net;
}

inline std::vector<core::InstructionSet> supportedSets() {
    std::vector<core::InstructionSet> sets;
    for (core::InstructionSet set :
         {core::InstructionSet::sse2, core::InstructionSet::avx2, core::InstructionSet::avx512})
        if (core::isSupported(set)) sets.push_back(set);
    return sets;
}

// Puts the instruction set in use back at its end.
class InstructionSetGuard {
  public:
    InstructionSetGuard() = default;
    ~InstructionSetGuard() { core::useInstructionSet(before_); }
    InstructionSetGuard(const InstructionSetGuard&) = delete;
    InstructionSetGuard& operator=(const InstructionSetGuard&) = delete;

  private:
    core::InstructionSet before_ = core::instructionSet();
};

}  // namespace taut::mechanics::test
