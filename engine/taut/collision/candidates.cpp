#include "taut/collision/private/candidates.h"

#include <algorithm>
#include <bit>

namespace taut::collision {
namespace {

// A new room should last for so many steps like the last one. A block that rests gets a share of its size.
constexpr double stepsAhead = 16.0;
constexpr double shareOfSize = 0.02;

bool holds(const core::Aabb& outer, const core::Aabb& inner) {
    return outer.contains(inner.low) && outer.contains(inner.high);
}

bool overlap(const core::Aabb& a, const core::Aabb& b) {
    return a.low.x <= b.high.x && a.high.x >= b.low.x && a.low.y <= b.high.y && a.high.y >= b.low.y &&
           a.low.z <= b.high.z && a.high.z >= b.low.z;
}

double largest(const dvec3& a) {
    return std::max(a.x, std::max(a.y, a.z));
}

}  // namespace

template <class Real>
double reachOf(double thickness, const core::Aabb& box) {
    const dvec3 most = glm::max(glm::abs(box.low), glm::abs(box.high));
    return thickness + 20.0 * skinPerMetre<Real> * (most.x + most.y + most.z);
}
template double reachOf<float>(double, const core::Aabb&);
template double reachOf<double>(double, const core::Aabb&);

Candidates::Candidates() : rooms_(std::make_unique<CandidateRooms>()) {}
Candidates::~Candidates() = default;
Candidates::Candidates(Candidates&&) noexcept = default;
Candidates& Candidates::operator=(Candidates&&) noexcept = default;
void Candidates::drop() {
    rooms_->drop();
}

bool CandidateRooms::fits(const Solid& solid, const SolidRoom& room) {
    if (solid.bounded) return holds(room.box, solid.bounds);
    return solid.above.normal == room.above.normal && solid.above.offset <= room.above.offset;
}

bool CandidateRooms::meet(const Solid& solid, const SolidRoom& room, const BlockRoom& block) {
    if (solid.bounded) {
        core::Aabb box = room.box;
        box.grow(block.reach);
        return overlap(block.box, box);
    }
    const dvec3& normal = room.above.normal;
    return glm::dot(normal, block.box.centre()) - glm::dot(glm::abs(normal), block.box.halfSize()) <
           room.above.offset + block.reach;
}

void CandidateRooms::note(std::size_t block, std::size_t solid, bool near) {
    std::uint64_t& word = bits_[block * words_ + solid / 64];
    const std::uint64_t bit = std::uint64_t{1} << (solid % 64);
    word = near ? word | bit : word & ~bit;
    if (near) blocks_[block].isNear = true;
}

void CandidateRooms::follow(std::span<const Solid> solids) {
    if (solids_.size() != solids.size()) {
        solids_.assign(solids.size(), {});
        drop();
        bits_.clear();
        words_ = (solids.size() + 63) / 64;
    }
    for (std::size_t s = 0; s < solids.size(); ++s) {
        const Solid& solid = solids[s];
        SolidRoom& room = solids_[s];
        if (fits(solid, room)) continue;
        if (solid.bounded) {
            room.box = solid.bounds;
            if (!solid.still) room.box.grow(std::min(stepsAhead * solid.travel, largest(solid.bounds.halfSize())));
        } else {
            room.above = solid.above;
            if (!solid.still) room.above.offset += stepsAhead * solid.travel;
        }
        for (std::size_t block = 0; block < blocks_.size(); ++block)
            if (blocks_[block].isKnown) note(block, s, meet(solid, room, blocks_[block]));
    }
}

template <class Real>
void CandidateRooms::look(std::span<const Solid> solids, std::size_t block, const BlockRows<Real>& rows,
                          double thickness, core::Aabb& box) {
    near_.clear();
    if (block >= blocks_.size()) {
        blocks_.resize(block + 1);
        bits_.resize(blocks_.size() * words_);
    }
    BlockRoom& room = blocks_[block];
    bool isKnown = room.isKnown && room.thickness == thickness;
    if (isKnown && !room.isNear && staysIn(rows, room.box)) return;
    box = boundsOf(rows);
    isKnown = isKnown && holds(room.box, box);
    // The block has left its room: it gets a new one, grown by its way, and is compared with all solids.
    if (!isKnown) {
        BlockRows<Real> ends = rows;
        for (int k = 0; k < 3; ++k) ends.before[k] = ends.after[k];
        const core::Aabb end = boundsOf(ends);
        const dvec3 way = glm::max(end.low - box.low, box.high - end.high);  // of the box, the longer of two sides'
        room.box = box;
        room.box.grow(std::max(stepsAhead * largest(way), shareOfSize * largest(box.high - box.low)));
        room.reach = reachOf<Real>(thickness, room.box);
        room.thickness = thickness;
        room.isKnown = true;
        room.isNear = false;
        for (std::size_t s = 0; s < solids.size(); ++s) note(block, s, meet(solids[s], solids_[s], room));
    }
    if (!room.isNear) return;
    for (std::size_t w = 0; w < words_; ++w)
        for (std::uint64_t rest = bits_[block * words_ + w]; rest != 0; rest &= rest - 1)
            near_.push_back(&solids[w * 64 + static_cast<std::size_t>(std::countr_zero(rest))]);
}
template void CandidateRooms::look(std::span<const Solid>, std::size_t, const BlockRows<float>&, double, core::Aabb&);
template void CandidateRooms::look(std::span<const Solid>, std::size_t, const BlockRows<double>&, double, core::Aabb&);

}  // namespace taut::collision
