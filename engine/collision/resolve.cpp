#include <array>
#include <type_traits>

#include "taut/collision/cull.h"
#include "taut/collision/impl.h"
#include "taut/collision/response.h"

namespace taut::collision {

namespace {

constexpr int blockSize = 256;
constexpr int mostAtOnce = 32;  // solids that a block of points is tried against: the bits of a mask
constexpr int mostPasses = 4;   // over the solids that one point touches

// What free fall adds to a speed in two steps: a resting point arrives with about one step's worth each time, and a
// bounce from less would end within the step that follows.
constexpr double restSpeedPerSecond = 2.0 * 9.81;  // [m/s²]

// Rounding of a coordinate of 1 m, some times over: of the state, and of the frames it is taken through.
template <class Real>
constexpr double skinPerMetre = std::is_same_v<Real, float> ? 4.8e-7 : 4e-15;

template <class Real>
class Resolver {
  public:
    Resolver(const std::vector<Solid>& solids, const MovingPoints<Real>& points, double h,
             std::vector<Contact>& contacts)
        : solids_(solids), points_(points), h_(h), contacts_(contacts) {}

    void resolveBlock(int first, int last) {
        BlockRows<Real> rows;
        for (int k = 0; k < 3; ++k) {
            rows.before[k] = points_.xBefore + k * points_.stride + first;
            rows.after[k] = points_.x + k * points_.stride + first;
        }
        rows.count = last - first;
        Box box = boundsOf(rows);
        const dvec3 largest = glm::max(glm::abs(box.low), glm::abs(box.high));
        const double margin = points_.thickness + 20.0 * skinPerMetre<Real> * (largest.x + largest.y + largest.z);

        std::array<const Solid*, mostAtOnce> near;
        int count = 0;
        for (const Solid& solid : solids_) {
            if (!mayTouch(solid, box, margin)) continue;
            if (count == mostAtOnce) {
                if (last - first == 1) {  // one point within reach of more than 32 boxes: group after group
                    resolveAgainst(first, rows, near, count, margin);
                    count = 0;
                } else {
                    const int middle = first + (last - first) / 2;
                    resolveBlock(first, middle);
                    resolveBlock(middle, last);
                    return;
                }
            }
            near[static_cast<std::size_t>(count++)] = &solid;
        }
        if (count > 0) resolveAgainst(first, rows, near, count, margin);
    }

  private:
    static bool mayTouch(const Solid& solid, const Box& box, double margin) {
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

    void resolveAgainst(int first, const BlockRows<Real>& rows, const std::array<const Solid*, mostAtOnce>& near,
                        int count, double margin) {
        std::array<std::uint32_t, blockSize> mask{};
        for (int c = 0; c < count; ++c) {
            const Solid& solid = *near[static_cast<std::size_t>(c)];
            if (solid.bounded) {
                Box box = solid.bounds;
                box.grow(margin);
                markNearBox(rows, box, 1U << c, mask.data());
            } else {
                markUnderPlane(rows, solid.above.normal, solid.above.offset, margin, 1U << c, mask.data());
            }
        }
        for (int i = 0; i < rows.count; ++i) {
            const std::uint32_t bits = mask[static_cast<std::size_t>(i)];
            if (bits != 0 && points_.inverseMass[first + i] != Real(0)) resolvePoint(first + i, bits, near);
        }
    }

    void resolvePoint(int i, std::uint32_t bits, const std::array<const Solid*, mostAtOnce>& near) {
        const int s = points_.stride;
        const Real* const before = points_.xBefore + i;
        Real* const x = points_.x + i;
        Real* const v = points_.v + i;
        MovingPoint point{{before[0], before[s], before[2 * s]}, {x[0], x[s], x[2 * s]}, {v[0], v[s], v[2 * s]}};
        const dvec3 sum = point.before + point.x + point.v;
        if (!isFinite(sum.x + sum.y + sum.z)) return;  // for the caller to find
        const double skin = skinPerMetre<Real> * (std::abs(point.before.x) + std::abs(point.before.y) +
                                                  std::abs(point.before.z) + points_.thickness);

        // Pressed out of one solid a point may stand in another: a few passes in the same order, then it is left.
        const Solid& first = *near[static_cast<std::size_t>(__builtin_ctz(bits))];
        const bool single = (bits & (bits - 1)) == 0 && first.convex;
        const int passes = single ? 1 : mostPasses;
        const std::size_t firstContact = contacts_.size();
        bool touches = false;
        Impact impact;
        for (int pass = 0; pass < passes; ++pass) {
            bool again = false;
            for (std::uint32_t rest = bits; rest != 0; rest &= rest - 1) {
                const Solid& solid = *near[static_cast<std::size_t>(__builtin_ctz(rest))];
                if (!resolveOne(solid, skin, pass == mostPasses - 1, point, impact)) continue;
                touches = true;
                again |= impact.shifted;
                report(firstContact, i, solid.collider, impact);
            }
            if (!again) break;
        }
        if (!touches) return;
        for (int k = 0; k < 3; ++k) {
            x[k * s] = point.rests ? before[k * s] : static_cast<Real>(point.x[k]);
            v[k * s] = static_cast<Real>(point.v[k]);
        }
    }

    bool resolveOne(const Solid& solid, double skin, bool isLast, MovingPoint& point, Impact& impact) const {
        const bool jumped = solid.travel > fastestSurface * h_;
        const Surface surface{solid.from,
                              solid.to,
                              jumped || solid.still,
                              solid.material.friction * points_.friction,
                              solid.material.restitution,
                              h_,
                              restSpeedPerSecond * h_,
                              fastestSurface};
        Path world{point.before, point.x, points_.thickness, skin};
        Touch touch{};
        bool crossed = false;
        if (!solid.bounded) {
            if (!surface.still) world.from = solid.to.toWorld(solid.from.toLocal(point.before));
            touch = {solid.above.normal, solid.above.offset + world.thickness};
        } else {
            const double least = solid.convex ? 0.0 : 8.0 * skin;
            if (world.thickness < least) world.thickness = least;
            const dvec3 localStart = (jumped ? solid.to : solid.from).toLocal(point.before);
            if (!surface.still) world.from = solid.to.toWorld(localStart);
            const Path local{localStart, solid.to.toLocal(point.x), world.thickness, skin};
            if (jumped || solid.turn.empty()) {
                if (!solid.form->sweep(local, touch, crossed)) return false;
            } else if (!sweepTurning(solid, point, local, touch, crossed)) {
                return false;
            }
            touch.normal = solid.to.directionToWorld(touch.normal);
            touch.offset += glm::dot(touch.normal, solid.to.position);
        }
        if (!respond(surface, world, touch, point, impact)) return false;
        if (isLast && crossed) {  // wedged in a fold of the mesh: it goes where the mesh goes
            point.x = world.from;
            point.v = surfaceVelocity(surface, world.from);
            point.rests = surface.still;
        }
        return true;
    }

    // A solid that turns far is followed frame by frame; the first touch counts.
    static bool sweepTurning(const Solid& solid, const MovingPoint& point, const Path& whole, Touch& touch,
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
    void report(std::size_t firstContact, int i, int collider, const Impact& impact) {
        for (std::size_t c = firstContact; c < contacts_.size(); ++c) {
            if (contacts_[c].collider != collider) continue;
            contacts_[c].impulse += impact.impulse;
            contacts_[c].position = impact.position;
            contacts_[c].normal = impact.normal;
            return;
        }
        contacts_.push_back({i, collider, impact.position, impact.normal, impact.impulse});
    }

    const std::vector<Solid>& solids_;
    const MovingPoints<Real>& points_;
    const double h_;
    std::vector<Contact>& contacts_;
};

}  // namespace

template <class Real>
void Colliders::resolve(const MovingPoints<Real>& points, double h, std::vector<Contact>& contacts) const {
    Resolver<Real> resolver(impl_->solids, points, h, contacts);
    for (int first = points.first; first < points.last; first += blockSize)
        resolver.resolveBlock(first, first + blockSize < points.last ? first + blockSize : points.last);
}

template void Colliders::resolve(const MovingPoints<float>&, double, std::vector<Contact>&) const;
template void Colliders::resolve(const MovingPoints<double>&, double, std::vector<Contact>&) const;

}  // namespace taut::collision
