// What Candidates keeps: an enlarged box (room) for every solid and every block of points, and which of them overlap.
// It knows no contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/private/contact_kernel.h"
#include "taut/collision/private/cull.h"
#include "taut/collision/private/solid.h"

namespace taut::collision {

// Points that are tried together.
inline constexpr int candidateBlock = contactBatch;

// How near to a solid the points have to be to be tried at all: the distance that they keep, and roundings of the
// largest coordinate in their box [m].
template <class Real>
double reachOf(double thickness, const core::Aabb& box);

class CandidateRooms {
  public:
    // Gives new rooms to solids that have left theirs. Before the blocks of a step.
    void follow(std::span<const Solid> solids);
    // Of a block of a step, counting from 0, those that it may touch, into near(); `box` is that of all paths unless
    // there are none.
    template <class Real>
    void look(std::span<const Solid> solids, std::size_t block, const BlockRows<Real>& rows, double thickness,
              core::Aabb& box);

    const std::vector<const Solid*>& near() const { return near_; }
    void drop() { blocks_.clear(); }

    std::vector<Contact> scratch;

  private:
    // A bounded solid stays in the box, a half-space under the plane.
    struct SolidRoom {
        core::Aabb box;
        HalfSpace above{};
    };
    struct BlockRoom {
        core::Aabb box;
        double reach = 0.0;      // [m] see reachOf
        double thickness = 0.0;  // [m]
        bool isKnown = false;
        bool isNear = false;  // to any solid
    };
    static bool fits(const Solid& solid, const SolidRoom& room);
    static bool meet(const Solid& solid, const SolidRoom& room, const BlockRoom& block);
    void note(std::size_t block, std::size_t solid, bool near);

    std::vector<SolidRoom> solids_;
    std::vector<BlockRoom> blocks_;
    std::vector<std::uint64_t> bits_;  // (blocks × words_) solids whose room the block's room meets
    std::size_t words_ = 0;
    std::vector<const Solid*> near_;
};

}  // namespace taut::collision
