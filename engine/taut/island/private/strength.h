// The lengths at which the springs of an island yield or break, and which of the springs that are too long break at
// once. It changes nothing.
//
// Far from a tear a sheet is strained evenly, and a spring breaks at the break strain ε_break for any cell size.
// At the tip of a tear this would depend on the mesh: the strain of the next spring grows as 1/√l when the cell l
// shrinks, while the energy that a tear takes per area is a property of the material. The crack band model (Bažant and
// Oh 1983, with a sudden drop) makes that energy independent of the mesh: the break strain at the tip grows as
// √(l_ref/l), where l_ref is the cell for which ε_break is stated.
//
// Long cells concentrate strain less than that. Beside n broken springs of a lattice ε_tip² ≈ ε_far² (1 + α n), so the
// limit at the tip is ε_break √(l_ref/l + 0.08).
//
//   o   o---o---o    The tear has come from the left between two rows. The spring beside the last broken one is at the
//           ║        tip: its ends neighbour the ends of a broken spring along springs that hold. So do the ends of the
//   o   o---o---o    diagonals (not shown). Springs along the edges of the tear are not at the tip.
//
// When a spring breaks, springs near it are relieved. If all springs that are too long broke in one step, some would
// break that the first break would have saved. So a spring breaks only if no other in its reach is further over. The
// rest are looked at again after the next step.
//
// Yielding moves the rest length so far that the yield strain is left. The break strain counts from the length that the
// spring was made with, so yielding does not raise the length at which a spring breaks.
#pragma once

#include <span>
#include <vector>

#include "taut/mechanics/private/spring_watch.h"
#include "taut/plan/island_plan.h"

namespace taut::world {

class Strength {
  public:
    // Expects that the plan outlives it and that its points and springs keep their order.
    explicit Strength(const IslandPlan& plan);

    mechanics::LengthLimits limitsOf(int spring) const;
    std::vector<mechanics::LengthLimits> limits() const;  // (springs)

    // For a spring of length l [m]: overload() is its strain as a factor of the break strain, above 1 if it breaks.
    // yieldedLength() is the rest length [m] that leaves it strained by no more than the yield strain.
    double overload(int spring, double l) const;
    double yieldedLength(int spring, double l) const;

    struct Break {
        int spring;
        double overload;
    };
    // The overloaded springs that no other in reach exceeds, so that the others first feel the relief. Two
    // springs are in reach if they share a point or have neighbouring points.
    std::vector<int> firstToBreak(std::vector<Break> over) const;

  private:
    struct Way {
        int to;      // point
        int spring;  // of the plan
    };
    std::span<const Way> from(int point) const {
        const auto p = static_cast<std::size_t>(point);
        return {ways_.data() + first_[p], ways_.data() + first_[p + 1]};
    }
    bool isOwn(int spring) const { return plan_.origins[spring].body >= 0; }
    bool isBend(int spring) const { return plan_.springs[spring].kind == mechanics::SpringKind::bend; }
    // Calls each(point) for the point and its neighbours along structural springs that hold.
    template <class Each>
    bool anyNear(int point, Each&& each) const;
    bool isAtTip(int spring) const;
    double breakStrain(int spring) const;  // infinite for never

    const IslandPlan& plan_;
    std::vector<std::size_t> first_;  // (points + 1) into ways_
    std::vector<Way> ways_;           // from each point
};

}  // namespace taut::world
