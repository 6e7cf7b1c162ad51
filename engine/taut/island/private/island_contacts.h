// The contacts of an island's points, between its method and the colliders. It knows no tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "taut/collision/colliders.h"
#include "taut/island/private/contact_watch.h"
#include "taut/island/private/planar.h"
#include "taut/mechanics/mass_spring_system.h"
#include "taut/ode/method.h"
#include "taut/plan/constraint.h"

namespace taut::world {

template <class Real>
class IslandContacts {
  public:
    using Planes = core::AlignedArray<Real>;
    using Method = ode::Method<Real>;

    // Expects that all three outlive it.
    IslandContacts(const IslandPlan& plan, mechanics::MassSpringSystem<Real>& system, ode::State<Real>& state)
        : plan_(plan),
          system_(system),
          state_(state),
          planar_{system.layout().stride},
          before_(system.layout().size()) {}

    // Keeps the positions before a step.
    void remember() {
        std::copy(state_.x.begin(), state_.x.end(), before_.begin());
        if (watch_.isOn()) std::copy(state_.v.begin(), state_.v.end(), watch_.vStart.begin());
    }
    std::span<const int> touched() const { return touched_; }  // points, by the last collide()

    // After the step of length h [s] that began at t [s]. gravity: of uniform fields [m/s²].
    bool collide(const collision::Colliders& colliders, Method& method, double t, double h, const dvec3& gravity,
                 std::vector<collision::Contact>* contacts) {
        findColliding(std::sqrt(glm::dot(gravity, gravity)));
        touched_.clear();
        if (watch_.isOn()) watch_.remember(state_.x, state_.v, method.predicted(state_));
        records_.clear();
        const bool records = contacts != nullptr || watch_.isOn() || method.yields();
        colliders.resolve(std::span<const collision::MovingPoints<Real>>(colliding_), h, feet_, touched_,
                          records ? &records_ : nullptr);
        if (touched_.empty()) return false;
        method.touch(state_, touched_);
        if (method.yields()) letYield(colliders, method, t, h);
        if (watch_.isOn()) addWork(colliders, method.yields(), h, gravity);
        if (contacts != nullptr) contacts->insert(contacts->end(), records_.begin(), records_.end());
        return true;
    }

    // Moves the listed points, which began inside a collider, outwards at most at `speed` [m/s]. Points that are out
    // leave the list.
    void emerge(const collision::Colliders& colliders, Method& method, double h, double speed,
                std::vector<int>& inside) {
        const double most = speed * h;
        more_.clear();
        std::erase_if(inside, [&](int i) {
            if (system_.inverseMasses()[i] == Real(0)) return false;
            const dvec3 before = planar_.at(before_, i), way = planar_.at(state_.x, i) - before;
            const double length = std::sqrt(glm::dot(way, way));
            if (!(length > most)) return colliders.inside(before + way).depth <= most;
            planar_.set(state_.x, i, before + way * (most / length));
            planar_.set(state_.v, i, way * (speed / length));
            more_.push_back(i);
            return false;
        });
        if (!more_.empty()) method.touch(state_, more_);
    }

    // Moves points (ascending) to x [m] with velocities v [m/s]; colliders may stop them. Writes the result back to x
    // and v. h [s] and gravity are those of the last step.
    void place(const collision::Colliders* colliders, Method& method, double h, const dvec3& gravity,
               std::span<const int> points, std::span<dvec3> x, std::span<dvec3> v) {
        if (colliders != nullptr) {
            findColliding(std::sqrt(glm::dot(gravity, gravity)));
            if (!method.yields()) takeBackImpulses(points, v);
        }
        const auto count = static_cast<int>(points.size());
        if (placed_.size() < 3 * points.size()) placed_ = placedFrom_ = placedSpeeds_ = Planes(6 * points.size());
        const Planar<Real> few{static_cast<int>(placed_.size() / 3)};
        placedMasses_.clear();
        for (int k = 0; k < count; ++k) {
            const auto own = static_cast<std::size_t>(k);
            few.set(placedFrom_, k, planar_.at(state_.x, points[own]));
            few.set(placed_, k, x[own]);
            few.set(placedSpeeds_, k, v[own]);
            placedMasses_.push_back(system_.inverseMasses()[points[own]]);
        }
        if (colliders != nullptr)
            for (const collision::MovingPoints<Real>& body : colliding_) {
                const auto first = std::lower_bound(points.begin(), points.end(), body.first);
                const auto last = std::lower_bound(first, points.end(), body.last);
                collision::MovingPoints<Real> own = body;
                own.first = static_cast<int>(first - points.begin());
                own.last = static_cast<int>(last - points.begin());
                own.stride = few.stride;
                own.xBefore = placedFrom_.data();
                own.x = placed_.data();
                own.v = placedSpeeds_.data();
                own.inverseMass = placedMasses_.data();
                collision::Feet feet;
                more_.clear();
                if (own.last > own.first)
                    colliders->resolve(std::span<const collision::MovingPoints<Real>>(&own, 1), h, feet, more_,
                                       nullptr);
            }
        for (int k = 0; k < count; ++k) {
            const auto own = static_cast<std::size_t>(k);
            x[own] = few.at(placed_, k);
            v[own] = few.at(placedSpeeds_, k);
            planar_.set(state_.x, points[own], x[own]);
            planar_.set(state_.v, points[own], v[own]);
        }
        method.touch(state_, points);
    }

    // Forces have acted on these velocities for `seconds` [s] since the state, the pressure of other bodies has not.
    // Adds its accelerations of the last step of contact. An impact does not last, so each addition is limited by
    // the change by forces.
    void bear(std::span<const ContactAcceleration> pressed, double seconds, Planes& velocities) const {
        constexpr double most = 2.0;  // times the change by forces
        for (const ContactAcceleration& one : pressed) {
            const dvec3 v = planar_.at(velocities, one.point), added = v - planar_.at(state_.v, one.point);
            const dvec3 push = seconds * one.acceleration;
            const double size = std::sqrt(glm::dot(push, push)), limit = most * std::sqrt(glm::dot(added, added));
            planar_.set(velocities, one.point, v + (size > limit ? limit / size : 1.0) * push);
        }
    }
    // Forces have changed these velocities since the state. Removes, point by point, the components that contacts stop.
    void bear(std::span<const collision::Contact> contacts, Planes& velocities) const {
        forEachPoint(
            contacts,
            [&](std::span<const collision::Contact> own) {
                const int point = own.front().point;
                const dvec3 v = planar_.at(velocities, point);
                if (v != planar_.at(state_.v, point))
                    planar_.set(velocities, point, collision::velocityInContact(own, v));
            });
    }

    // Whether collide() sums up how it changes the energy.
    void watch(bool isOn) {
        if (!isOn)
            watch_ = {};
        else if (!watch_.isOn())
            watchAnew();
    }
    // To be called when cells and springs have changed.
    void rewatch() {
        if (watch_.isOn()) watchAnew();
    }
    ContactWork takeWork() { return watch_.take(); }

  private:
    void watchAnew() { watch_.start(plan_, cellsOf(plan_), system_.layout().stride); }

    // Colliders do not stop points that a collider carries by a constraint.
    const Real* inverseMasses() {
        const Real* all = system_.inverseMasses();
        carried_.clear();
        for (const auto& constraint : plan_.constraints)
            for (const int i : constraint->points())
                if (constraint->carries(i)) carried_.push_back(i);
        if (carried_.empty()) return all;
        masses_.assign(all, all + planar_.stride);
        for (const int i : carried_) masses_[i] = Real(0);
        return masses_.data();
    }

    void findColliding(double gravity) {
        colliding_.clear();
        const Real* inverseMass = inverseMasses();
        for (const Body* body : plan_.bodies) {
            if (!body->spec->collide || body->lastPoint == body->firstPoint) continue;
            if (body->spec->meetsCollidersAsWhole()) continue;  // in contact with other bodies
            collision::MovingPoints<Real>& points = colliding_.emplace_back();
            points.first = body->firstPoint;
            points.last = body->lastPoint;
            points.stride = planar_.stride;
            points.xBefore = before_.data();
            points.x = state_.x.data();
            points.v = state_.v.data();
            points.inverseMass = inverseMass;
            points.thickness = body->spec->thickness;
            points.friction = body->spec->friction;
            points.restitution = body->spec->restitution;
            points.gravity = gravity;
        }
    }

    // The step led points into colliders, which stopped them. A point that contact lifts again did not need as much of
    // that impulse. Otherwise its velocity v would be above that of its way, and it would hop.
    void takeBackImpulses(std::span<const int> points, std::span<dvec3> v) {
        for (collision::Contact& contact : records_) {
            const auto found = std::lower_bound(points.begin(), points.end(), contact.point);
            if (found == points.end() || *found != contact.point) continue;
            dvec3& own = v[static_cast<std::size_t>(found - points.begin())];
            const double lift = glm::dot(contact.normal, own - planar_.at(state_.v, contact.point));
            const double back = std::max(0.0, std::min(lift, contact.impulse));
            own -= back * contact.normal;
            contact.impulse -= back;
        }
    }

    // Points that touch are held up, and the others move accordingly. Points that this leads into a collider are
    // brought out in turn. Friction follows the load that a point then bears, including that of others.
    void letYield(const collision::Colliders& colliders, Method& method, double t, double h) {
        constexpr int mostRounds = 4;
        supports_.clear();
        slides_.clear();
        addSupports(records_);
        for (int round = 1;; ++round) {
            method.yield(system_, t, h, state_, supports_);
            if (round == mostRounds) return;
            const bool changes = rub(h, round == 1);
            findMore(colliders, h);
            if (more_.empty() && !changes) return;
            if (more_.empty()) continue;
            method.touch(state_, more_);
            addSupports(moreRecords_);
            const auto old = static_cast<std::ptrdiff_t>(touched_.size());
            touched_.insert(touched_.end(), more_.begin(), more_.end());
            std::inplace_merge(touched_.begin(), touched_.begin() + old, touched_.end());
            records_.insert(records_.end(), moreRecords_.begin(), moreRecords_.end());
        }
    }

    // Finds the points that are inside a collider by now: more_ and moreRecords_.
    void findMore(const collision::Colliders& colliders, double h) {
        moreRecords_.clear();
        more_.clear();
        colliders.resolve(std::span<const collision::MovingPoints<Real>>(colliding_), h, feet_, more_, &moreRecords_);
        const auto isOld = [&](int i) { return std::binary_search(touched_.begin(), touched_.end(), i); };
        std::erase_if(more_, isOld);
        std::erase_if(moreRecords_, [&](const collision::Contact& contact) { return isOld(contact.point); });
    }

    // Points that slide on a surface move along it.
    void addSupports(std::span<const collision::Contact> records) {
        forEachPoint(
            records,
            [&](std::span<const collision::Contact> contacts) {
                const collision::Contact& first = contacts.front();
                Slide slide{first.carried, dvec3(0.0), first.friction};
                const dvec3 u = planar_.at(state_.v, first.point) - first.carried;
                const dvec3 across = u - glm::dot(u, first.normal) * first.normal;
                const double speed = std::sqrt(glm::dot(across, across));
                const bool sticks = first.friction > 0 && speed <= 1e-6 * first.impulse;
                ode::Support support{first.point};
                if (contacts.size() == 1 && !sticks) {
                    support.normal = {first.normal.x, first.normal.y, first.normal.z};
                    if (speed > 0) slide.direction = across / speed;
                    setRub(support, slide, first.impulse);
                }
                supports_.push_back(support);
                slides_.push_back(slide);
            });
    }

    struct Slide {
        dvec3 carried;    // [m/s] velocity of the surface
        dvec3 direction;  // unit, in which the point moves along the surface; 0 where it does not slide
        double friction;  // Coulomb's μ
    };
    static void setRub(ode::Support& support, const Slide& slide, double impulse) {
        const dvec3 rub = -slide.friction * std::max(impulse, 0.0) * slide.direction;
        support.rub = {rub.x, rub.y, rub.z};
    }

    // Applies friction by the impulses found. Points that it would turn round stick. Returns whether that changes
    // anything; the first time, whether there is friction.
    bool rub(double h, bool isFirst) {
        bool changes = false;
        for (std::size_t i = 0; i < supports_.size(); ++i) {
            ode::Support& support = supports_[i];
            const Slide& slide = slides_[i];
            const dvec3 n(support.normal[0], support.normal[1], support.normal[2]);
            if (!(slide.friction > 0) || slide.direction == dvec3(0.0) || n == dvec3(0.0)) continue;
            changes = changes || isFirst;
            setRub(support, slide, support.impulse);
            const dvec3 u = planar_.at(state_.v, support.point) - slide.carried;
            if (glm::dot(u, slide.direction) > 0) continue;
            const dvec3 before = planar_.at(before_, support.point) + h * slide.carried;
            const dvec3 x = planar_.at(state_.x, support.point);
            planar_.set(state_.x, support.point, before + glm::dot(x - before, n) * n);
            planar_.set(state_.v, support.point, slide.carried + glm::dot(u, n) * n);
            support = {support.point};
            changes = true;
        }
        return changes;
    }

    // Adds the work on points that were outside before the step. Points that begin inside a collider, or nearer than
    // its thickness, are left out: a shorter step would add as much for them.
    void addWork(const collision::Colliders& colliders, bool isAll, double h, const dvec3& gravity) {
        outside_.clear();
        forEachPoint(records_, [&](std::span<const collision::Contact> contacts) {
            const int point = contacts.front().point;
            const dvec3 carried = contacts.front().carried, before = planar_.at(before_, point);
            const double thickness = thicknessOf(point);
            const double trifle = 1e-3 * thickness + 2e-6 * (1.0 + std::sqrt(glm::dot(before, before)));
            const double moved = h * std::sqrt(glm::dot(carried, carried));
            if (colliders.distance(before) >= thickness - moved - trifle) outside_.push_back(point);
        });
        if (!isAll)
            addWorkOnTouched(gravity);
        else if (outside_.size() == touched_.size())
            addWorkOnAll(gravity);
    }
    double thicknessOf(int point) const {
        for (const auto& points : colliding_)
            if (point >= points.first && point < points.last) return points.thickness;
        return 0.0;
    }

    // The energy before and after, with velocities at the time of the positions: half of the last
    // kick is added. A moving surface does work of its own. Seen from the surface it is zero.
    void addWorkOnTouched(const dvec3& gravity) {
        forEachPoint(records_, [&](std::span<const collision::Contact> contacts) {
            const int point = contacts.front().point;
            planar_.set(watch_.w, point, planar_.at(watch_.w, point) - contacts.front().carried);
        });
        watch_.meetAtTouch(plan_, gravity);
        if (outside_.empty()) return;
        const double before = watch_.energy(plan_, outside_, false, watch_.x, watch_.w, gravity);
        for (std::size_t i = 0; i < watch_.w.size(); ++i) watch_.w[i] = state_.v[i] + (watch_.w[i] - watch_.v[i]);
        forEachPoint(records_, [&](std::span<const collision::Contact> contacts) {
            const int point = contacts.front().point;
            const dvec3 carried = contacts.front().carried;
            const dvec3 v = collision::velocityInContact(contacts, planar_.at(watch_.w, point) + carried) - carried;
            planar_.set(watch_.w, point, v);
        });
        watch_.add(watch_.energy(plan_, outside_, false, state_.x, watch_.w, gravity) - before);
    }

    // A step that is solved again keeps energy that, without contact, it would have turned into motion and damped. So
    // energy above that at the start of the step also counts as added by contact. Where a surface moves its work cannot
    // be told apart.
    void addWorkOnAll(const dvec3& gravity) {
        const bool moves = std::any_of(records_.begin(), records_.end(),
                                       [](const collision::Contact& contact) { return contact.carried != dvec3(0.0); });
        if (moves) return;
        watch_.meetAtTouch(plan_, gravity);
        const double before = std::max(watch_.energy(plan_, touched_, true, watch_.x, watch_.v, gravity),
                                       watch_.energy(plan_, touched_, true, before_, watch_.vStart, gravity));
        watch_.add(std::max(0.0, watch_.energy(plan_, touched_, true, state_.x, state_.v, gravity) - before));
    }

    // Calls each(contacts of a point) for all points.
    template <class Each>
    static void forEachPoint(std::span<const collision::Contact> contacts, Each&& each) {
        for (std::size_t first = 0; first < contacts.size();) {
            std::size_t last = first;
            while (last < contacts.size() && contacts[last].point == contacts[first].point) ++last;
            each(contacts.subspan(first, last - first));
            first = last;
        }
    }

    const IslandPlan& plan_;
    mechanics::MassSpringSystem<Real>& system_;
    ode::State<Real>& state_;
    Planar<Real> planar_;
    Planes before_;                                         // positions at the start of the step
    std::vector<collision::MovingPoints<Real>> colliding_;  // bodies
    collision::Feet feet_;
    std::vector<int> touched_, more_;                        // points
    std::vector<int> outside_;                               // those of touched_ that were outside before the step
    std::vector<collision::Contact> records_, moreRecords_;  // of the last collide(), if it kept them
    std::vector<Slide> slides_;                              // (supports)
    std::vector<ode::Support> supports_;                     // (supports)
    ContactWatch<Real> watch_;
    Planes placed_, placedFrom_, placedSpeeds_;  // scratch for place()
    std::vector<Real> placedMasses_;             // scratch for place()
    std::vector<int> carried_;                   // scratch for place(): points
    std::vector<Real> masses_;                   // (points) [1/kg], where some are carried
};

}  // namespace taut::world
