#include <algorithm>
#include <array>

#include "taut/collision/private/contact_kernel.h"
#include "taut/collision/private/cull.h"
#include "taut/collision/private/foot_finder.h"
#include "taut/collision/private/foot_rows.h"
#include "taut/collision/private/impl.h"
#include "taut/collision/private/response.h"
#include "taut/core/private/instruction_set.h"

namespace taut::collision {

// Of all bodies of an island, in blocks of contactBatch points.
struct FootMemory {
    std::shared_ptr<const char> of;  // identity of the colliders
    std::vector<FootRows> feet;      // (blocks) as far as they came near a mesh
    // Scratch:
    std::vector<core::Aabb> boxes;     // (blocks of a body) [m] of the paths
    std::vector<const Solid*> solids;  // all, those near a body, those near its first half …
    std::vector<Contact> contacts;

    FootRows& at(std::size_t block) {
        if (block >= feet.size()) feet.resize(block + 1);
        return feet[block];
    }
};

TAUT_KERNELS(template <class Real> std::int64_t contact(const ContactArgs<Real>&, ContactLanes&);)

namespace {

constexpr int mostAtOnce = 32;  // solids that a block of points is tried against: the bits of a mask
constexpr int smallBlock = 16;  // points; a block that is near to several solids is not halved below this size

using namespace TAUT_ISA;  // of response.h

// A point during a step, in the world.
struct MovingPoint {
    dvec3 before;  // [m]
    dvec3 x;       // [m]
    dvec3 v;       // [m/s]
};

struct Impact {
    double impulse;  // normal, per mass [m/s]
    dvec3 position;  // on the surface [m]
    dvec3 normal;
    dvec3 carried;  // velocity of the surface [m/s]
    bool isMoved;   // the point, by more than rounding
};

template <class Real>
class Resolver {
  public:
    Resolver(const std::vector<Solid>& solids, const MovingPoints<Real>& points, double h, FootMemory& memory,
             std::size_t firstBlock, std::vector<int>& touched, std::vector<Contact>& contacts, bool records)
        : solids_(solids),
          points_(points),
          h_(h),
          restSpeed_(2.0 * points.gravity * h),
          memory_(memory),
          firstBlock_(firstBlock),
          touched_(touched),
          contacts_(contacts),
          records_(records) {}

    // Returns how many blocks it has.
    std::size_t resolveBody() {
        memory_.boxes.clear();
        for (int first = points_.first; first < points_.last; first += contactBatch)
            memory_.boxes.push_back(boundsOf(rowsOf(first, std::min(first + contactBatch, points_.last))));
        memory_.solids.clear();
        for (const Solid& solid : solids_) memory_.solids.push_back(&solid);
        resolveBlocks(0, memory_.boxes.size(), 0);
        return memory_.boxes.size();
    }

  private:
    // Some blocks of the body against those of the solids, from `from` on, that are near them. Halves are near to fewer
    // of many.
    void resolveBlocks(std::size_t first, std::size_t last, std::size_t from) {
        constexpr std::size_t many = 8;
        core::Aabb box;
        for (std::size_t block = first; block < last; ++block) box.add(memory_.boxes[block]);
        const double reach = reachOf(box);
        const std::size_t end = memory_.solids.size();
        for (std::size_t s = from; s < end; ++s)
            if (mayTouch(*memory_.solids[s], box, reach)) memory_.solids.push_back(memory_.solids[s]);
        const std::size_t found = memory_.solids.size() - end;
        if (found > many && last - first > 1) {
            const std::size_t middle = first + (last - first) / 2;
            resolveBlocks(first, middle, end);
            resolveBlocks(middle, last, end);
        } else if (found > 0) {
            for (block_ = first; block_ < last; ++block_)
                resolveBlock(firstOf(block_), std::min(firstOf(block_ + 1), points_.last), memory_.boxes[block_], end);
        }
        memory_.solids.resize(end);
    }
    int firstOf(std::size_t block) const { return points_.first + contactBatch * static_cast<int>(block); }

    // [m] Points are tried against a solid if they are nearer to it than this: the distance that they keep, plus
    // roundings of the largest coordinate in their box.
    double reachOf(const core::Aabb& box) const {
        const dvec3 most = glm::max(glm::abs(box.low), glm::abs(box.high));
        return points_.thickness + 20.0 * skinPerMetre<Real> * (most.x + most.y + most.z);
    }

    using Near = std::array<const Solid*, mostAtOnce>;

    BlockRows<Real> rowsOf(int first, int last) const {
        BlockRows<Real> rows;
        for (int k = 0; k < 3; ++k) {
            rows.before[k] = points_.xBefore + k * points_.stride + first;
            rows.after[k] = points_.x + k * points_.stride + first;
        }
        rows.count = last - first;
        return rows;
    }

    // Points of one block.
    void resolveBlock(int first, int last, const core::Aabb& box, std::size_t from) {
        const BlockRows<Real> rows = rowsOf(first, last);
        const double reach = reachOf(box);
        Near near;
        int count = 0;
        for (std::size_t s = from; s < memory_.solids.size(); ++s) {
            const Solid* solid = memory_.solids[s];
            if (!mayTouch(*solid, box, reach)) continue;
            if (count == mostAtOnce) {
                if (last - first > 1) return halve(first, last, from);
                resolveAgainst(first, rows, near, count, reach);  // one point near more solids takes group after group
                count = 0;
            }
            near[count++] = solid;
        }
        // Most parts of a block are near to only one solid, and those cost least.
        if (count > 1 && last - first > smallBlock) return halve(first, last, from);
        if (count > 0) resolveAgainst(first, rows, near, count, reach);
    }

    void halve(int first, int last, std::size_t from) {
        const int middle = first + (last - first) / 2;
        resolveBlock(first, middle, boundsOf(rowsOf(first, middle)), from);
        resolveBlock(middle, last, boundsOf(rowsOf(middle, last)), from);
    }

    static bool mayTouch(const Solid& solid, const core::Aabb& box, double margin) {
        if (solid.bounded) {
            const dvec3 low = solid.bounds.low - margin;
            const dvec3 high = solid.bounds.high + margin;
            return box.low.x <= high.x && box.high.x >= low.x && box.low.y <= high.y && box.high.y >= low.y &&
                   box.low.z <= high.z && box.high.z >= low.z;
        }
        const dvec3& normal = solid.above.normal;
        return glm::dot(normal, box.centre()) - glm::dot(glm::abs(normal), box.halfSize()) <
               solid.above.offset + margin;
    }

    void resolveAgainst(int first, const BlockRows<Real>& rows, const Near& near, int count, double margin) {
        if (count == 1 && isForKernel(*near[0])) return resolveBatch(first, rows.count, near);
        std::array<std::uint32_t, contactBatch> mask{};
        for (int c = 0; c < count; ++c) {
            const Solid& solid = *near[c];
            if (solid.bounded) {
                core::Aabb box = solid.bounds;
                box.grow(margin);
                markNearBox(rows, box, 1U << c, mask.data());
            } else {
                markUnderPlane(rows, solid.above.normal, solid.above.offset, margin, 1U << c, mask.data());
            }
        }
        resolveBatch(first, rows.count, near, mask.data());
    }

    bool isForKernel(const Solid& solid) const {
        return (solid.closed.kind != ClosedKind::none || solid.feet != nullptr) &&
               (!solid.bounded || hasJumped(solid, h_) || solid.turn.empty());
    }

    // The kernel resolves points that may touch only one solid, if it knows the solid's shape. All other points are
    // resolved one by one.
    void resolveBatch(int first, int n, const Near& near, const std::uint32_t* mask) {
        // Which solids have points that may touch no other.
        std::uint32_t some = 0;
        std::uint32_t singles = 0;
        for (int i = 0; i < n; ++i) {
            const std::uint32_t bits = mask[i];
            some |= bits;
            singles |= (bits & (bits - 1)) == 0 ? bits : 0U;
        }
        if (some == 0) return;
        std::array<PointOutcome, contactBatch> outcome{};
        std::array<Contact, contactBatch> records;
        std::uint32_t taken = 0;  // solids that the kernel has handled
        for (std::uint32_t rest = singles; rest != 0; rest &= rest - 1) {
            const auto c = static_cast<unsigned>(__builtin_ctz(rest));
            const Solid& solid = *near[c];
            if (!isForKernel(solid)) continue;
            taken |= 1U << c;
            ContactArgs<Real> args = argsFor(solid, first, n);
            args.mask = mask;
            args.bits = 1U << c;
            if (kernel_(args, lanes_) == 0) continue;
            for (int i = 0; i < n; ++i) {
                const auto k = static_cast<std::size_t>(i);
                if (lanes_.outcome[i] == 0) continue;
                outcome[k] = static_cast<PointOutcome>(lanes_.outcome[i]);
                if (records_) records[k] = recordOf(first + i, solid, i);
            }
        }
        // The rest one by one. Touched points and contacts keep the order of the points.
        for (int i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (outcome[k] == PointOutcome::touched) {
                touched_.push_back(first + i);
                if (records_) contacts_.push_back(records[k]);
                continue;
            }
            const bool isDone = (mask[i] & (mask[i] - 1)) == 0 && (mask[i] & ~taken) == 0;
            if (isDone && outcome[k] == PointOutcome::free) continue;
            if (points_.inverseMass[first + i] != Real(0)) resolvePoint(first + i, mask[i], near);
        }
    }

    // All points against one solid whose shape the kernel knows.
    void resolveBatch(int first, int n, const Near& near) {
        const std::int64_t found = kernel_(argsFor(*near[0], first, n), lanes_);
        if (found == anyTouched && !records_) {
            std::array<int, contactBatch> touched;
            std::size_t count = 0;
            for (int i = 0; i < n; ++i) {
                touched[count] = first + i;
                count += lanes_.outcome[i] != 0 ? 1U : 0U;
            }
            touched_.insert(touched_.end(), touched.begin(), touched.begin() + static_cast<std::ptrdiff_t>(count));
        } else if (found != 0) {
            for (int i = 0; i < n; ++i) {
                const auto outcome = static_cast<PointOutcome>(lanes_.outcome[i]);
                if (outcome == PointOutcome::left) resolvePoint(first + i, 1U, near);
                if (outcome != PointOutcome::touched) continue;
                touched_.push_back(first + i);
                if (records_) contacts_.push_back(recordOf(first + i, *near[0], i));
            }
        }
    }

    Contact recordOf(int point, const Solid& solid, int lane) const {
        const bool still = solid.still || hasJumped(solid, h_);
        return {point,
                solid.collider,
                {lanes_.position[0][lane], lanes_.position[1][lane], lanes_.position[2][lane]},
                {lanes_.normal[0][lane], lanes_.normal[1][lane], lanes_.normal[2][lane]},
                lanes_.impulse[lane],
                still ? dvec3(0.0) : dvec3(lanes_.carried[0][lane], lanes_.carried[1][lane], lanes_.carried[2][lane]),
                frictionOn(solid)};
    }

    double frictionOn(const Solid& solid) const { return solid.material.friction * points_.friction; }
    double restitutionOn(const Solid& solid) const { return solid.material.restitution * points_.restitution; }

    static KernelFrame frameFor(const Frame& frame) {
        KernelFrame plain;
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) plain.rotation[i][k] = frame.rotation[i][k];
            plain.position[i] = frame.position[i];
        }
        plain.turned = frame.turned;
        return plain;
    }

    ContactArgs<Real> argsFor(const Solid& solid, int first, int n) const {
        ContactArgs<Real> args;
        args.n = n;
        for (int k = 0; k < 3; ++k) {
            args.before[k] = points_.xBefore + k * points_.stride + first;
            args.x[k] = points_.x + k * points_.stride + first;
            args.v[k] = points_.v + k * points_.stride + first;
            args.normal[k] = solid.above.normal[k];
        }
        args.inverseMass = points_.inverseMass + first;
        args.mask = nullptr;
        args.bits = 0;
        args.records = records_;
        args.shape = solid.closed;
        if (solid.feet != nullptr)
            args.feet = {.finder = solid.feet,
                         .facets = solid.feet->facetNumbers(),
                         .isClosed = solid.feet->isClosed(),
                         .rows = &memory_.at(firstBlock_ + block_),
                         .first = first - firstOf(block_),
                         .find = findFeet};
        args.offset = solid.above.offset;
        args.to = frameFor(solid.to);
        args.still = solid.still || hasJumped(solid, h_);
        args.from = args.still ? args.to : frameFor(solid.from);
        args.thickness = points_.thickness;
        args.skinPerMetre = skinPerMetre<Real>;
        args.friction = frictionOn(solid);
        args.restitution = restitutionOn(solid);
        args.h = h_;
        args.restSpeed = restSpeed_;
        args.fastest = fastestSurface;
        return args;
    }

    void resolvePoint(int i, std::uint32_t bits, const Near& near) {
        const int s = points_.stride;
        const Real* const before = points_.xBefore + i;
        Real* const x = points_.x + i;
        Real* const v = points_.v + i;
        MovingPoint point{{before[0], before[s], before[2 * s]}, {x[0], x[s], x[2 * s]}, {v[0], v[s], v[2 * s]}};
        const dvec3 sum = point.before + point.x + point.v;
        if (!isFinite(sum.x + sum.y + sum.z)) return;  // the caller will find it
        const double skin = skinPerMetre<Real> * (std::abs(point.before.x) + std::abs(point.before.y) +
                                                  std::abs(point.before.z) + points_.thickness);

        // A point that was moved out of one solid may stand in another. So there are a few passes in the same order.
        // Then the point stays where it is.
        const Solid& first = *near[__builtin_ctz(bits)];
        const bool single = (bits & (bits - 1)) == 0 && first.convex;
        const int passes = single ? 1 : mostPasses;
        const std::size_t firstContact = contacts_.size();
        bool touches = false;
        Impact impact;
        for (int pass = 0; pass < passes; ++pass) {
            bool again = false;
            for (std::uint32_t rest = bits; rest != 0; rest &= rest - 1) {
                const Solid& solid = *near[__builtin_ctz(rest)];
                if (!resolveOne(solid, skin, pass == mostPasses - 1, point, impact)) continue;
                touches = true;
                again |= impact.isMoved;
                report(firstContact, i, solid, impact);
            }
            if (!again) break;
        }
        if (!records_) contacts_.clear();
        if (!touches) return;
        touched_.push_back(i);
        for (int k = 0; k < 3; ++k) {
            x[k * s] = static_cast<Real>(point.x[k]);
            v[k * s] = static_cast<Real>(point.v[k]);
        }
    }

    bool resolveOne(const Solid& solid, double skin, bool isLast, MovingPoint& point, Impact& impact) const {
        const bool jumped = hasJumped(solid, h_), still = jumped || solid.still;
        Path world{point.before, point.x, points_.thickness, skin};
        HalfSpace touch{};
        bool crossed = false;
        if (!solid.bounded) {
            if (!still) world.from = solid.to.toWorld(solid.from.toLocal(point.before));
            touch = {solid.above.normal, solid.above.offset + world.thickness};
        } else {
            const double least = solid.convex ? 0.0 : 8.0 * skin;
            if (world.thickness < least) world.thickness = least;
            const dvec3 localStart = (jumped ? solid.to : solid.from).toLocal(point.before);
            if (!still) world.from = solid.to.toWorld(localStart);
            const Path local{localStart, solid.to.toLocal(point.x), world.thickness, skin};
            if (jumped || solid.turn.empty()) {
                if (!solid.form->sweep(local, touch, crossed)) return false;
            } else if (!sweepTurning(solid, point, local, touch, crossed)) {
                return false;
            }
            touch.normal = solid.to.directionToWorld(touch.normal);
            touch.offset += glm::dot(touch.normal, solid.to.position);
        }
        const dvec3 onSurface = vectorOf(placeUnder(of(world.to), of(touch.normal), touch.offset, world.thickness));
        const dvec3 carried = still ? dvec3(0.0) : velocityAt(solid, onSurface);
        const Surface surface{still, frictionOn(solid), restitutionOn(solid), restSpeed_};
        const Touch<double> met{of(world.from), of(point.x), of(point.v), of(touch.normal),
                                touch.offset,   world.skin,  of(carried)};
        const Response<double> response = respond(surface, met);
        if (!response.arrives) return false;
        point.x = vectorOf(response.x);
        point.v = vectorOf(response.v);
        impact = {response.impulse, onSurface, touch.normal, carried, response.isMoved != 0};
        if (!response.reports) return false;
        if (isLast && crossed) {  // it is wedged in a fold of the mesh, so it goes where the mesh goes
            point.x = world.from;
            point.v = still ? dvec3(0.0) : velocityAt(solid, world.from);
        }
        return true;
    }

    static Triple<double> of(const dvec3& v) { return {v.x, v.y, v.z}; }
    static dvec3 vectorOf(const Triple<double>& v) { return {v.x, v.y, v.z}; }

    // The velocity of the surface's place that ends the step at `place`: its way during the step over h.
    dvec3 velocityAt(const Solid& solid, const dvec3& place) const {
        const dvec3 v = (place - solid.from.toWorld(solid.to.toLocal(place))) / h_;
        const double speed = std::sqrt(glm::dot(v, v));
        return speed > fastestSurface ? v * (fastestSurface / speed) : v;
    }

    // A solid that turns far is followed frame by frame; the first touch counts.
    static bool sweepTurning(const Solid& solid, const MovingPoint& point, const Path& whole, HalfSpace& touch,
                             bool& crossed) {
        Path piece = whole;
        const std::size_t pieces = solid.turn.size() + 1;
        for (std::size_t k = 1; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            piece.to = k == pieces ? whole.to : solid.turn[k - 1].toLocal(point.before + t * (point.x - point.before));
            if (solid.form->sweep(piece, touch, crossed)) return true;
            piece.from = piece.to;
        }
        return false;
    }

    // A solid that is touched again in a later pass adds to its contact.
    void report(std::size_t firstContact, int i, const Solid& solid, const Impact& impact) {
        for (std::size_t c = firstContact; c < contacts_.size(); ++c) {
            if (contacts_[c].collider != solid.collider) continue;
            contacts_[c].impulse += impact.impulse;
            contacts_[c].position = impact.position;
            contacts_[c].normal = impact.normal;
            contacts_[c].carried = impact.carried;
            return;
        }
        contacts_.push_back(
            {i, solid.collider, impact.position, impact.normal, impact.impulse, impact.carried, frictionOn(solid)});
    }

    const std::vector<Solid>& solids_;
    const MovingPoints<Real>& points_;
    const double h_;
    // The speed that free fall adds in two steps. A resting point arrives with about the speed of one step each time. A
    // bounce from less than this would end within the next step.
    const double restSpeed_;
    FootMemory& memory_;
    const std::size_t firstBlock_;  // of the body, among those of all bodies
    std::size_t block_ = 0;         // of the body
    std::vector<int>& touched_;
    std::vector<Contact>& contacts_;
    const bool records_;  // whether the caller wants contacts
    std::int64_t (*const kernel_)(const ContactArgs<Real>&, ContactLanes&) = TAUT_IN_USE(contact<Real>);
    ContactLanes lanes_;
};

}  // namespace

dvec3 velocityInContact(std::span<const Contact> contacts, dvec3 v) {
    // One of several surfaces may push the point against another.
    const int passes = contacts.size() > 1 ? mostPasses : 1;
    for (int pass = 0; pass < passes; ++pass)
        for (const Contact& contact : contacts) {
            const dvec3 u = v - contact.carried;
            const double un = glm::dot(u, contact.normal);
            if (!(un < 0.0)) continue;
            const dvec3 slide = u - un * contact.normal;
            const double slideSquare = glm::dot(slide, slide), grip = contact.friction * -un;
            const bool sticks = slideSquare <= grip * grip;
            v = sticks ? contact.carried : contact.carried + slide * (1.0 - grip / std::sqrt(slideSquare));
        }
    return v;
}

template <class Real>
void Colliders::resolve(std::span<const MovingPoints<Real>> bodies, double h, Feet& feet, std::vector<int>& touched,
                        std::vector<Contact>* contacts) const {
    if (feet.memory_ == nullptr) feet.memory_ = std::make_shared<FootMemory>();
    FootMemory& memory = *feet.memory_;
    if (memory.of != impl_->identity) {
        memory.feet.clear();
        memory.of = impl_->identity;
    }
    std::size_t block = 0;
    for (const MovingPoints<Real>& points : bodies)
        block += Resolver<Real>(impl_->solids, points, h, memory, block, touched,
                                contacts != nullptr ? *contacts : memory.contacts, contacts != nullptr)
                     .resolveBody();
}

template <class Real>
void Colliders::resolve(const MovingPoints<Real>& points, double h, std::vector<Contact>& contacts) const {
    Feet feet;
    std::vector<int> touched;
    resolve(std::span(&points, 1), h, feet, touched, &contacts);
}

template void Colliders::resolve(std::span<const MovingPoints<float>>, double, Feet&, std::vector<int>&,
                                 std::vector<Contact>*) const;
template void Colliders::resolve(std::span<const MovingPoints<double>>, double, Feet&, std::vector<int>&,
                                 std::vector<Contact>*) const;
template void Colliders::resolve(const MovingPoints<float>&, double, std::vector<Contact>&) const;
template void Colliders::resolve(const MovingPoints<double>&, double, std::vector<Contact>&) const;

}  // namespace taut::collision
