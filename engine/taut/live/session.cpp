#include "taut/live/session.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "taut/core/error.h"
#include "taut/ecs/registry.h"
#include "taut/live/private/worker.h"
#include "taut/spec/ticks.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t mostWatched = 12;  // bodies whose strain is kept for proposed checks
constexpr double gripShare = 0.025;      // of a body's diagonal: how far around the point a hand takes others too

double diagonalOf(const BodyPoints& body) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& p : body.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return body.positions.empty() ? 0.0 : glm::length(high - low);
}

world::SceneSpec withHands(world::SceneSpec spec) {
    spec.hand.anywhere = true;
    return spec;
}

// A name that no hand of the scene's own timeline has.
std::string freeId(const world::SceneSpec& spec) {
    std::string id = world::liveHand;
    const auto isTaken = [&] {
        return world::anyForeseen<world::GrabAction>(spec.actions,
                                                     [&](const world::GrabAction& grab) { return grab.id == id; });
    };
    while (isTaken()) id += "-2";
    return id;
}

}  // namespace

struct Session::Impl {
    world::World world;
    double ticksPerSecond;
    MouseHand hand;
    world::Specs<world::ActionSpec> asked;  // for the next tick
    world::Specs<world::ActionSpec> deeds;
    std::vector<std::pair<std::string, double>> strains;
    view::FrameView before, now;
    world::Metrics metrics;
    bool marks = false;
    std::optional<world::Divergence> divergence;
    std::vector<std::string> faults;

    Worker worker;  // last, so that it ends before the data it uses

    Impl(const world::SceneSpec& spec, int threads)
        : world(spec, {.threads = threads}),
          ticksPerSecond(spec.run.fps * world.ticksPerFrame()),
          hand(freeId(spec), ticksPerSecond) {
        world.registry().each<world::BodyPart>([&](ecs::Entity, const world::BodyPart& part) {
            if (strains.size() < mostWatched) strains.emplace_back(part.body->fullName(), 0.0);
        });
        before = now = look();
        measure();
    }

    view::FrameView look() const {
        view::FrameView view = world.view(marks);
        view.frame = world.tick() / world.ticksPerFrame();
        view.time = world.time();
        return view;
    }

    void measure() {
        metrics = world.metrics();
        for (auto& [body, strain] : strains) {
            const double of = strains.size() == 1 ? metrics.maxStrain : world.metrics(body).maxStrain;
            strain = std::max(strain, of);
        }
    }

    void tickOnce() {
        for (const auto& actions : {std::exchange(asked, {}), hand.deedsAt(world.tick())})
            for (const world::ActionSpec& action : actions) {
                try {
                    world.apply(action);
                } catch (const core::Error& error) {
                    faults.emplace_back(error.what());
                    continue;
                }
                deeds.add(action.copy());
            }
        divergence = world.advance();
    }

    void work(int ticks, double seconds) {
        const auto start = Clock::now();
        for (int done = 0; done < ticks && !divergence;) {
            tickOnce();
            ++done;
            // Another tick as long as those before would pass the budget.
            const double spent = std::chrono::duration<double>(Clock::now() - start).count();
            const bool isLate = spent + spent / done > seconds;
            if (done + 2 > ticks || isLate || divergence) before = std::exchange(now, look());
            if (isLate) break;
        }
        measure();
    }
};

Session::Session(world::SceneSpec spec, int threads)
    : spec_(withHands(std::move(spec))), impl_(std::make_unique<Impl>(spec_, threads)) {}
Session::Session(world::SceneSpec spec, int threads, const Session& from) : Session(std::move(spec), threads) {
    Impl& w = *impl_;
    const Impl& other = *from.impl_;
    w.world.restore(other.world.save());
    w.hand = other.hand;
    w.asked = other.asked;
    w.deeds = other.deeds;
    w.strains = other.strains;
    w.before = w.now = w.look();
    w.measure();
}
Session::~Session() = default;

void Session::begin(int ticks, double budget) {
    if (ticks <= 0 || impl_->divergence) return;
    impl_->worker.begin([this, ticks, budget] { impl_->work(ticks, budget); });
}

void Session::wait() {
    impl_->worker.wait();
}

const world::World& Session::world() const {
    return impl_->world;
}
std::int64_t Session::tick() const {
    return impl_->world.tick();
}
const world::Metrics& Session::metrics() const {
    return impl_->metrics;
}
const view::FrameView& Session::before() const {
    return impl_->before;
}
const view::FrameView& Session::now() const {
    return impl_->now;
}
MouseHand& Session::hand() {
    return impl_->hand;
}
const world::Specs<world::ActionSpec>& Session::deeds() const {
    return impl_->deeds;
}
const std::optional<world::Divergence>& Session::divergence() const {
    return impl_->divergence;
}
std::vector<std::string> Session::takeFaults() {
    return std::exchange(impl_->faults, {});
}

void Session::showMarks(bool shown) {
    impl_->marks = shown;
    impl_->before = impl_->now = impl_->look();
}

std::vector<BodyPoints> Session::bodies(bool withHeld) const {
    std::vector<BodyPoints> all;
    impl_->world.registry().each<world::BodyPart>([&](ecs::Entity entity, const world::BodyPart& part) {
        BodyPoints body{part.body->fullName(), {}, {}};
        const std::vector<glm::dvec3> positions = impl_->world.positions(entity);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (part.body->model.held[i] && !withHeld) continue;
            body.points.push_back(static_cast<int>(i));
            body.positions.push_back(positions[i]);
        }
        all.push_back(std::move(body));
    });
    return all;
}

double Session::handForce(const std::string& body) const {
    constexpr double earth = 9.81;  // [m/s²]
    const std::vector<world::IslandInfo> islands = impl_->world.islands();
    const auto has = [](const world::IslandInfo& island, const std::string& name) {
        return std::find(island.bodies.begin(), island.bodies.end(), name) != island.bodies.end();
    };
    const auto own =
        std::find_if(islands.begin(), islands.end(), [&](const auto& island) { return has(island, body); });
    double mass = 0.0;
    impl_->world.registry().each<world::BodyPart>([&](ecs::Entity, const world::BodyPart& part) {
        if (own == islands.end() || !has(*own, part.body->fullName())) return;
        const std::vector<double> masses = impl_->world.points(part.body->fullName()).mass;
        for (std::size_t i = 0; i < masses.size(); ++i) mass += part.body->model.held[i] ? 0.0 : masses[i];
    });
    return weights * earth * mass;
}

void Session::grab(const PickedPoint& point) {
    const std::vector<BodyPoints> all = bodies();
    const auto body =
        std::find_if(all.begin(), all.end(), [&](const BodyPoints& other) { return other.name == point.body; });
    TAUT_EXPECTS(body != all.end());
    hand().grab(nameOf(point), gripShare * diagonalOf(*body), spec_.hand.strength, spec_.hand.dampingRatio,
                point.position, handForce(point.body));
}

void Session::apply(const world::ActionSpec& action) {
    impl_->asked.add(action.copy());
}

double Session::nextTime() const {
    return MouseHand::momentOf(tick(), impl_->ticksPerSecond);
}

Recording Session::record() {
    Impl& w = *impl_;
    const auto isWhole = [&] {
        const bool isFollowed =
            w.deeds.empty() || world::Ticks(spec_.run).at(w.deeds[w.deeds.size() - 1].t) < w.world.tick();
        return isFollowed && w.world.tick() % w.world.ticksPerFrame() == 0;
    };
    if (w.hand.isHolding()) w.hand.release();
    w.tickOnce();
    while (!isWhole() && !w.divergence) w.tickOnce();
    w.before = w.now = w.look();
    w.measure();

    Recording recording;
    recording.run = spec_.run;
    recording.ticksPerSecond = w.ticksPerSecond;
    recording.ticksPerFrame = w.world.ticksPerFrame();
    recording.endTick = w.world.tick();
    recording.hash = w.world.stateHash();
    recording.timeline = spec_.actions;
    recording.actionKinds = spec_.actionKinds;
    recording.deeds = w.deeds;
    recording.hasClaims = !spec_.checks.empty() || !spec_.goldens.empty();
    recording.strains = w.strains;
    return recording;
}

}  // namespace taut::live
