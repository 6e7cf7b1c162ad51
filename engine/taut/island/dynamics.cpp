#include "taut/island/private/dynamics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "taut/island/private/constraint_slot.h"
#include "taut/island/private/island_contacts.h"
#include "taut/island/private/rounding_watch.h"
#include "taut/island/report.h"
#include "taut/mechanics/private/anchor.h"
#include "taut/mechanics/private/element_bending.h"
#include "taut/mechanics/private/grid_bending.h"
#include "taut/mechanics/private/grid_friction.h"
#include "taut/mechanics/private/place_springs.h"
#include "taut/plan/private/tie_ends.h"
#include "taut/plan/private/ties.h"

namespace taut::world {
namespace {

template <class Real>
class DynamicsOf final : public Dynamics {
  public:
    DynamicsOf(const IslandPlan& plan, const ForceList& forces)
        : plan_(plan),
          system_(massesOf(plan), plan.ranges, plan.springs),
          state_(system_.layout()),
          bound_(system_.layout().count, system_.layout().stride),
          contacts_(plan_, system_, state_),
          constraints_(plan_, system_, state_) {
        lead();
        for (const Body* body : plan_.bodies)
            if (const mechanics::BendingFriction& friction = body->model.friction; !friction.isEmpty())
                frictions_.push_back(
                    {body, Planes(mechanics::GridFriction<Real>::sliderCount(friction, !body->clamped.empty())),
                     nullptr});
        setForces(forces);
        for (std::size_t i = 0; i < plan_.positions.size(); ++i) {
            set(state_.x, static_cast<int>(i), plan_.positions[i]);
            set(state_.v, static_cast<int>(i), plan_.velocities[i]);
        }
        velocity_ = core::AlignedArray<Real>(system_.layout().size());
        system_.setShareOut([this](double t, Real* v) {
            if (!constraints_.isEmpty()) constraints_.shareKick(t, v, isStepping_);
        });
    }

    void take(const Changes& changes, const ForceList& forces) override {
        const bool isMaterial = changes.has(Change::material), isShape = changes.has(Change::shape),
                   isDamage = isShape || changes.has(Change::damage);
        bound_.forgetWeights();
        if (isMaterial || isDamage || changes.has(Change::lengths)) system_.setSprings(plan_.springs);
        if (isMaterial || isShape || changes.has(Change::points) || changes.has(Change::grips)) {
            system_.setPoints(massesOf(plan_));
            lead();
        }
        if (isShape)
            constraints_.take();
        else if (isDamage || changes.has(Change::lengths))
            constraints_.follow();
        if (isDamage) return setForces(forces);
        if (isMaterial) contacts_.rewatch();
        if (isMaterial)
            for (const auto& [body, volume] : volumes_) volume->setBulkModuli(cellsOf(*body));
        if (isMaterial && !volumes_.empty()) bound_.setCells(cellsOf(plan_), restPositionsOf(plan_));
        if (isMaterial || changes.has(Change::points) || changes.has(Change::grips)) setBendings();
        if (changes.has(Change::grips)) addGrips();
    }

    void changeSprings(std::span<const int> springs) override {
        system_.changeSprings(springs, plan_.springs);
        constraints_.follow();
        bound_.forgetWeights();
    }
    void watchLengths(std::span<const mechanics::LengthLimits> limits) override {
        watch_.set(system_.network(), limits);
    }
    void watchLength(int spring, const mechanics::LengthLimits& limits) override {
        watch_.change(system_.network(), spring, limits);
    }
    void findBeyond(std::vector<int>& springs) const override {
        watch_.find(system_.network(), state_.layout.stride, state_.x.data(), springs);
    }

    void setForces(const ForceList& forces) override {
        system_.removeGenerators();
        volumes_.clear();
        gridBendings_.clear();
        elementBendings_.clear();
        acting_.clear();
        contacts_.rewatch();
        for (std::size_t number = 0; number < forces.size(); ++number) {
            if (number == 1) addInnerForces();  // after gravity
            std::unique_ptr<Generator> generator;
            if constexpr (std::is_same_v<Real, float>)
                generator = forces[number]->inSingle(plan_);
            else
                generator = forces[number]->inDouble(plan_);
            if (!generator) continue;
            acting_.emplace_back(number, generator.get());
            system_.add(std::move(generator));
        }
        if (forces.size() < 2) addInnerForces();
        addPulls();
        firstGrip_ = system_.generators().size();
        addGrips();
    }
    bool callsBack(const ForceList& forces) const override {
        return std::any_of(
            acting_.begin(), acting_.end(), [&](const auto& acting) { return forces[acting.first]->isCallback(); });
    }
    bool isSteady(const ForceList& forces) const override {
        return std::all_of(
            acting_.begin(), acting_.end(), [&](const auto& acting) { return forces[acting.first]->isSteady(); });
    }
    void steer(const ForceList& forces) override {
        for (const auto& [number, generator] : acting_) forces[number]->steer(*generator);
    }
    void leadGrip(std::size_t grip) override {
        if (anchors_[grip] != nullptr) anchors_[grip]->setPlace(plan_.grips[grip].path);
    }

    void start(double t, double h) override {
        if (!method_) makeMethod();
        step_ = h;
        if (!constraints_.isEmpty()) constraints_.start(t);
        method_->start(system_, t, h, state_);
        std::size_t size = 0;
        forEachPart([&](Real*, std::size_t n) { size += n; });
        keptSize_ = size;
    }
    void step(double t) override {
        time_ = t;
        if (!constraints_.isEmpty()) constraints_.remember(t);
        for (const Friction& friction : frictions_) friction.generator->slide(motion(t));
        isStepping_ = true;
        method_->step(system_, t, step_, state_);
        isStepping_ = false;
        speeds_ = leads_ ? ode::Speeds::unknown : method_->speeds();
        if (constraints_.isEmpty()) return;
        constraints_.project(*method_, t + step_, step_);
        speeds_ = ode::Speeds::unknown;
    }
    void rememberPositions() override { contacts_.remember(); }
    bool collide(const collision::Colliders& colliders, std::vector<collision::Contact>* contacts) override {
        speeds_ = ode::Speeds::unknown;
        return contacts_.collide(colliders, *method_, time_, step_, gravity(time_), contacts);
    }
    void place(const collision::Colliders* colliders, std::span<const int> points, std::span<dvec3> x,
               std::span<dvec3> v) override {
        speeds_ = ode::Speeds::unknown;
        contacts_.place(colliders, *method_, step_, gravity(time_), points, x, v);
    }
    bool settle() override {
        if (constraints_.isEmpty()) return false;
        speeds_ = ode::Speeds::unknown;
        if (!constraints_.settle(*method_, time_ + step_)) return false;
        return true;
    }
    double strain(double t, const std::vector<bool>& only) override {
        return constraints_.isEmpty() ? 0.0 : constraints_.strain(t, only);
    }
    void forgetImpulses() override {
        if (!constraints_.isEmpty()) constraints_.forgetImpulses();
    }
    dvec3 impulse(const JointTie::Part& part) const override {
        return constraints_.impulse(static_cast<std::size_t>(part.constraint), part.tie);
    }
    double turning(double t, double seconds) override {
        return constraints_.isEmpty() ? 0.0 : constraints_.turning(t, seconds);
    }
    std::span<const HeldPair> heldPairs(double t) override { return constraints_.heldPairs(t); }
    void watchContacts(bool isOn) override { contacts_.watch(isOn); }
    ContactWork takeContactWork() override { return contacts_.takeWork(); }
    dvec3 gravity(double t) const override {
        dvec3 sum(0.0);
        for (const auto& generator : system_.generators())
            if (generator->isUniform()) sum += generator->uniformAcceleration(t);
        return sum;
    }
    double freezingSpeed(double place) const override { return rounding_.freezingSpeed(place, step_); }
    Lost lost(double seconds, double most) override {
        return rounding_.find(state_, system_.inverseMasses(), step_, seconds, most);
    }
    void emerge(const collision::Colliders& colliders, std::vector<int>& inside) override {
        contacts_.emerge(colliders, *method_, step_, emergingSpeed, inside);
    }
    void keep(Since moment) override {
        std::vector<Real>& kept = kept_[static_cast<std::size_t>(moment)];
        kept.resize(keptSize_);
        Real* next = kept.data();
        forEachPart([&](const Real* numbers, std::size_t n) { next = std::copy_n(numbers, n, next); });
    }
    void goBack(Since moment) override {
        const Real* next = kept_[static_cast<std::size_t>(moment)].data();
        forEachPart([&](Real* numbers, std::size_t n) {
            std::copy_n(next, n, numbers);
            next += n;
        });
    }
    void setStep(double h) override { step_ = h; }
    mechanics::FastestNow fastestNow() override {
        mechanics::FastestNow now = bound_(system_.network(), state_.x.data(), system_.inverseMasses());
        now.pairs = system_.largestPairRate();
        return now;
    }
    void split(bool splits) override {
        splits_ = splits;
        system_.split(splits);
        method_.reset();
    }
    ode::Work work() const override { return method_->work(); }

    std::vector<dvec3> velocities() const override { return list(state_.v); }
    void velocities(std::span<dvec3> v) const override {
        for (std::size_t i = 0; i < v.size(); ++i) v[i] = at(state_.v, static_cast<int>(i));
    }
    std::vector<dvec3> velocitiesAt(double t, std::span<const collision::Contact> contacts,
                                    std::span<const ContactAcceleration> pressed) override {
        findVelocities(t, contacts, pressed);
        return list(velocity_);
    }
    void synchronise(double t, std::span<const collision::Contact> contacts) override {
        findVelocities(t, contacts, {});
        std::copy(velocity_.begin(), velocity_.end(), state_.v.begin());
    }
    void setVelocity(int point, const dvec3& v) override { set(state_.v, point, v); }
    bool isBounded() const override {
        if (speeds_ != ode::Speeds::unknown) return speeds_ == ode::Speeds::within;
        // Without their sign, numbers come in the order of their bits, infinity and NaN last. Adding `room` carries
        // numbers from the limit on into the sign bit. One cache line at a time, this takes a tenth of the time.
        using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
        constexpr Bits sign = Bits{1} << (8 * sizeof(Real) - 1);
        constexpr Bits room = sign - std::bit_cast<Bits>(static_cast<Real>(mechanics::speedLimit));
        constexpr int line = static_cast<int>(core::cacheLine / sizeof(Real));
        Bits beyond = 0;
        for (int p = 0; p < 3; ++p) {
            const Real* v = state_.v.data() + index(0, p);
            for (int first = 0; first < state_.layout.count; first += line)
                for (int i = first; i < first + line; ++i) beyond |= (std::bit_cast<Bits>(v[i]) & (sign - 1)) + room;
        }
        return (beyond & sign) == 0;
    }
    bool isTouchedBounded() const override {
        const std::span<const int> touched = contacts_.touched();
        // Checking all is faster than picking out more than a tenth.
        if (touched.size() * 10 > static_cast<std::size_t>(state_.layout.count)) return isBounded();
        const auto limit = static_cast<Real>(mechanics::speedLimit);
        return std::all_of(touched.begin(), touched.end(), [&](int i) {
            bool isBelow = true;
            for (int p = 0; p < 3; ++p) isBelow = isBelow && std::abs(state_.v[index(i, p)]) < limit;
            return isBelow;
        });
    }
    dvec3 position(int point) const override { return at(state_.x, point); }
    void positions(std::vector<dvec3>& x) const override {
        x.resize(state_.layout.count);
        positions(std::span(x));
    }
    void positions(std::span<dvec3> x) const override {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = at(state_.x, static_cast<int>(i));
    }

    mechanics::StabilityShare stabilityShare(double t) const override {
        mechanics::StabilityShare share{std::vector<double>(plan_.points.size(), 0.0),
                                        std::vector<double>(plan_.points.size(), 0.0)};
        for (const auto& generator : system_.generators()) generator->addStability(motion(t), share);
        return share;
    }
    void addEnergies(double t, const std::vector<bool>& only, double& weight, double& other) const override {
        for (const auto& generator : system_.generators())
            (generator->isWeight() ? weight : other) += generator->potentialEnergy(motion(t), only);
    }
    void addStiffnessProduct(std::span<const dvec3> u, std::span<dvec3> out) const override {
        core::AlignedArray<Real> in(state_.layout.size()), sum(state_.layout.size());
        for (std::size_t i = 0; i < u.size(); ++i) set(in, static_cast<int>(i), u[i]);
        for (const auto& generator : system_.generators())
            generator->addStiffnessProduct(motion(0.0), in.data(), sum.data());
        for (std::size_t i = 0; i < u.size(); ++i) out[i] += at(sum, static_cast<int>(i));
    }
    std::vector<std::pair<const Body*, mechanics::VolumeReport>> volumes(double t, bool stretches) const override {
        std::vector<std::pair<const Body*, mechanics::VolumeReport>> all;
        for (const auto& [body, volume] : volumes_) all.emplace_back(body, volume->inspect(motion(t), stretches));
        return all;
    }

    void addToHash(std::span<const int> points, core::Hash& hash) const override {
        for (const core::AlignedArray<Real>* array : {&state_.x, &state_.v})
            for (int i : points)
                for (int p = 0; p < 3; ++p) hash.add((*array)[index(i, p)]);
    }
    void addToHash(const Body& body, core::Hash& hash) const override {
        addToHash(body.pointOf, hash);
        for (const Friction& friction : frictions_)
            if (friction.body == &body)
                for (const Real slider : friction.sliders) hash.add(slider);
    }
    void visit(StateBytes& bytes) override {
        bytes.planes(state_.x);
        bytes.planes(state_.v);
        auto memory = static_cast<std::uint64_t>(state_.memory.size());
        bytes(memory);
        bytes.require(memory == state_.memory.size());
        for (auto& array : state_.memory) bytes.planes(array);
        for (Friction& friction : frictions_) bytes.planes(friction.sliders);
        rounding_.visit(bytes, state_.x.size());
        if (!bytes.isReading()) return;
        makeMethod();  // all that it keeps is in the state
        for (const Since moment : {Since::tick, Since::step}) keep(moment);
    }
    void describe(IslandInfo& info) const override {
        info.runs = static_cast<int>(system_.network().runs.size());
        info.singles = system_.network().singles.size();
        info.bytes = system_.bytes() + (3 + 2 * state_.memory.size()) * state_.layout.size() * sizeof(Real) * 2;
    }

  private:
    using System = mechanics::MassSpringSystem<Real>;
    using Generator = mechanics::ForceGenerator<Real>;
    using Planes = core::AlignedArray<Real>;

    static std::vector<mechanics::PointMass> massesOf(const IslandPlan& plan) {
        std::vector<mechanics::PointMass> points = plan.points;
        for (const Grip& grip : plan.grips)
            if (grip.rigid)
                for (int i : grip.points) points[i].held = true;
        return points;
    }

    // (points) [m]
    static std::vector<dvec3> restPositionsOf(const IslandPlan& plan) {
        std::vector<dvec3> rest(plan.points.size(), dvec3(0.0));
        for (const Body* body : plan.bodies)
            for (std::size_t i = 0; i < body->pointOf.size(); ++i) rest[body->pointOf[i]] = body->model.positions[i];
        return rest;
    }

    // Points in a rigid grip move with its holder.
    void lead() {
        leads_ = std::any_of(plan_.grips.begin(), plan_.grips.end(), [](const Grip& grip) { return grip.rigid; });
        for (std::size_t g = 0; g < plan_.grips.size(); ++g) {
            if (!plan_.grips[g].rigid) continue;
            system_.lead({plan_.grips[g].points, [this, g](double t, std::span<dvec3> x, std::span<dvec3> v) {
                              const Grip& grip = plan_.grips[g];
                              const mechanics::PosePath::Frame frame = grip.path.at(t);
                              for (std::size_t i = 0; i < x.size(); ++i) {
                                  const dvec3 arm = frame.arm(grip.offsets[i]);
                                  x[i] = frame.place + arm;
                                  v[i] = frame.velocityOf(arm);
                              }
                          }});
        }
    }

    // Springs of constraints, whose places on colliders move with these.
    void addPulls() {
        std::vector<mechanics::PlaceSpring> springs;
        for (const auto& constraint : plan_.constraints) {
            const std::span<const int> points = constraint->points();
            for (const Constraint::Pull& pull : constraint->pulls()) {
                mechanics::PlaceSpring& spring = springs.emplace_back();
                spring.stiffness = pull.stiffness;
                spring.damping = pull.damping;
                spring.length = pull.length;
                for (const auto& [number, weight] : TieEnds::difference(pull.a, pull.b)) {
                    const auto own = static_cast<std::size_t>(number);
                    if (own < points.size())
                        spring.shares.push_back({points[own], weight});
                    else
                        spring.second = [this, place = constraint->places()[own - points.size()]](double t) {
                            const mechanics::PosePath::Frame frame = pathOf(plan_, place.collider).at(t);
                            const dvec3 arm = frame.arm(place.offset);
                            return mechanics::PlaceSpring::Place{frame.place + arm, frame.velocityOf(arm)};
                        };
                }
            }
        }
        if (!springs.empty()) system_.add(std::make_unique<mechanics::PlaceSprings<Real>>(std::move(springs)));
    }

    // Adds the anchors of the other grips, as the last of the generators.
    void addGrips() {
        system_.removeGenerators(firstGrip_);
        anchors_.clear();
        for (const Grip& grip : plan_.grips) {
            anchors_.push_back(nullptr);
            if (grip.rigid) continue;
            auto anchor =
                std::make_unique<mechanics::Anchor<Real>>(grip.points, grip.path.place.from, grip.stiffness,
                                                          grip.damping, grip.offsets, grip.mostForce, grip.lengths);
            anchor->setPlace(grip.path);
            anchors_.back() = anchor.get();
            system_.add(std::move(anchor));
        }
    }

    // The friction of a body's threads, with its state.
    struct Friction {
        const Body* body;
        Planes sliders;
        mechanics::GridFriction<Real>* generator;  // of the system
    };

    // Adds the volume forces of each body that has cells.
    void addVolumes() {
        for (const Body* body : plan_.bodies) {
            const std::vector<mechanics::VolumeCell> cells = cellsOf(*body);
            if (cells.empty()) continue;
            auto volume = std::make_unique<mechanics::VolumePreservation<Real>>(cells, plan_.positions,
                                                                                body->model.workingStretch);
            volumes_.emplace_back(body, volume.get());
            system_.add(std::move(volume));
        }
        bound_.setCells(cellsOf(plan_), restPositionsOf(plan_));
    }

    void addInnerForces() {
        addVolumes();
        for (Friction& friction : frictions_) {
            const Body& body = *friction.body;
            auto generator = std::make_unique<mechanics::GridFriction<Real>>(gridFrictionOf(plan_, body), body.pointOf,
                                                                             friction.sliders, turnOf(body));
            friction.generator = generator.get();
            system_.add(std::move(generator));
        }
        for (const Body* body : plan_.bodies) {
            if (!body->model.bending.isEmpty()) {
                auto bending = std::make_unique<mechanics::GridBending<Real>>(gridBendingOf(plan_, *body),
                                                                              body->pointOf, turnOf(*body));
                gridBendings_.emplace_back(body, bending.get());
                system_.add(std::move(bending));
            }
            if (!body->model.freeform.isEmpty()) {
                auto bending = std::make_unique<mechanics::ElementBending<Real>>(
                    bendingElementsOf(plan_, *body), body->model.freeform.dampingTime, body->pointOf, turnOf(*body));
                elementBendings_.emplace_back(body, bending.get());
                system_.add(std::move(bending));
            }
        }
    }
    void setBendings() {
        for (const auto& [body, bending] : gridBendings_) bending->set(gridBendingOf(plan_, *body));
        for (const Friction& friction : frictions_) friction.generator->set(gridFrictionOf(plan_, *friction.body));
        for (const auto& [body, bending] : elementBendings_)
            bending->set(bendingElementsOf(plan_, *body), body->model.freeform.dampingTime);
    }

    // Directions that a collider holds turn with the collider.
    std::function<glm::dquat(double)> turnOf(const Body& body) const {
        if (body.carried.empty() || body.clamped.empty()) return {};
        return [this, &body, back = glm::conjugate(body.carriedFrom)](double t) {
            for (int i : body.carried)
                if (const Grip* grip = carrierOf(plan_, body.pointOf[i])) return grip->path.at(t).rotation * back;
            return glm::dquat(1, 0, 0, 0);
        };
    }

    void makeMethod() {
        const SolverSpec& solver = plan_.solver;
        method_ = methodsOf(solver).make<Real>(solver.integrator,
                                               {solver.newtonSteps, solver.cgTolerance, solver.cgIterations, splits_});
        method_->watch(static_cast<Real>(mechanics::speedLimit));
    }

    // The velocities at t into velocity_. Methods that store velocities at t have them resolved already.
    void findVelocities(double t, std::span<const collision::Contact> contacts,
                        std::span<const ContactAcceleration> pressed) {
        method_->synchronise(system_, t, step_, state_, velocity_.data());
        // Tied points share the change by forces, and contacts bear the rest. The points of a solid are pushed alike.
        if (plan_.constraints.size() > plan_.solids.size()) constraints_.projectVelocities(t, velocity_);
        contacts_.bear(pressed, 0.5 * step_, velocity_);
        contacts_.bear(contacts, velocity_);
        if (!constraints_.isEmpty()) constraints_.projectVelocities(t, velocity_);
    }

    mechanics::Motion<Real> motion(double t) const { return system_.motion(t, state_.x.data(), state_.v.data()); }
    std::size_t index(int point, int plane) const { return Planar<Real>{state_.layout.stride}.index(point, plane); }
    dvec3 at(const Planes& planes, int point) const { return Planar<Real>{state_.layout.stride}.at(planes, point); }
    void set(Planes& planes, int point, const dvec3& value) const {
        Planar<Real>{state_.layout.stride}.set(planes, point, value);
    }
    std::vector<dvec3> list(const Planes& planes) const {
        std::vector<dvec3> all;
        for (int i = 0; i < state_.layout.count; ++i) all.push_back(at(planes, i));
        return all;
    }
    // Calls each(numbers, count) for all parts of the state in use.
    template <class Each>
    void forEachPart(Each&& each) {
        const auto count = static_cast<std::size_t>(state_.layout.count);
        const auto planes = [&](Planes& array) {
            for (int p = 0; p < 3; ++p) each(array.data() + index(0, p), count);
        };
        planes(state_.x);
        planes(state_.v);
        for (Planes& array : state_.memory)
            if (array.size() == state_.layout.size())
                planes(array);
            else
                each(array.data(), array.size());
        for (Friction& friction : frictions_) each(friction.sliders.data(), friction.sliders.size());
    }

    const IslandPlan& plan_;
    System system_;
    // Among the system's generators:
    std::vector<std::pair<const Body*, mechanics::VolumePreservation<Real>*>> volumes_;
    std::vector<std::pair<const Body*, mechanics::GridBending<Real>*>> gridBendings_;
    std::vector<std::pair<const Body*, mechanics::ElementBending<Real>*>> elementBendings_;
    std::vector<Friction> frictions_;                         // of the bodies that have any
    std::vector<std::pair<std::size_t, Generator*>> acting_;  // the forces that act here, by their number
    std::size_t firstGrip_ = 0;
    std::vector<mechanics::Anchor<Real>*> anchors_;  // (grips) null for rigid ones

    std::unique_ptr<ode::Method<Real>> method_;
    double step_ = 0, time_ = 0;  // length and start of the last step [s]
    bool isStepping_ = false;
    bool splits_ = false;                        // the dashpots act apart from the other forces
    bool leads_ = false;                         // whether some grip is rigid
    ode::Speeds speeds_ = ode::Speeds::unknown;  // of the present state
    ode::State<Real> state_;
    // (moments) copies of the state, close together: one or two cache lines for small islands
    std::array<std::vector<Real>, 2> kept_;
    std::size_t keptSize_ = 0;
    mechanics::StateBound<Real> bound_;
    mechanics::SpringWatch<Real> watch_;
    IslandContacts<Real> contacts_;
    ConstraintSlot<Real> constraints_;
    Planes velocity_;  // scratch
    RoundingWatch<Real> rounding_;
};

}  // namespace

std::unique_ptr<Dynamics> makeDynamics(const IslandPlan& plan, const ForceList& forces) {
    if (plan.solver.precision == Precision::single_) return std::make_unique<DynamicsOf<float>>(plan, forces);
    return std::make_unique<DynamicsOf<double>>(plan, forces);
}

}  // namespace taut::world
