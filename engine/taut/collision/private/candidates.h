// The data of Candidates: an enlarged box (room) for every solid and every block of points, and which of them overlap.
// It knows no contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/collision/private/contact_kernel.h"
#include "taut/collision/private/cull.h"
#include "taut/collision/private/foot_rows.h"
#include "taut/collision/private/solid.h"

namespace taut::collision {

// Points that are tried together.
inline constexpr int candidateBlock = contactBatch;

// [m] Points are tried against a solid if they are nearer to it than this: the distance that they keep, plus roundings
// of the largest coordinate in their box.
template <class Real>
double reachOf(double thickness, const core::Aabb& box);

class CandidateRooms {
  public:
    // Gives new rooms to solids that have left theirs. Call it before the blocks of a step.
    void follow(std::span<const Solid> solids);
    // Finds the solids that a block of points (numbered from 0 in each step) may touch -> near(). `box` becomes the box
    // of all paths, unless near() is empty.
    template <class Real>
    void look(std::span<const Solid> solids, std::size_t block, const BlockRows<Real>& rows, double thickness,
              core::Aabb& box);

    const std::vector<const Solid*>& near() const { return near_; }
    // What is known of the feet of a block's points.
    FootRows& feet(std::size_t block) {
        if (block >= feet_.size()) feet_.resize(block + 1);
        return feet_[block];
    }
    void drop() {
        blocks_.clear();
        feet_.clear();
    }

    std::vector<Contact> scratch;

  private:
    // A bounded solid stays in the box, a half-space stays under the plane.
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
    std::vector<FootRows> feet_;       // (blocks) as far as they came near a mesh
    std::vector<std::uint64_t> bits_;  // (blocks × words_) solids whose room the block's room meets
    std::size_t words_ = 0;
    std::vector<const Solid*> near_;
};

}  // namespace taut::collision
