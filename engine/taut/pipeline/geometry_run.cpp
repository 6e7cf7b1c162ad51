#include "taut/pipeline/geometry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "taut/core/error.h"
#include "taut/pipeline/bounded_queue.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::pipeline {
namespace {

constexpr std::size_t framesWaiting = 4;

struct Delivery {
    view::FrameView view;
    std::vector<world::PointsNow> points;  // (targets)
};

// The simulating side; its results are valid after it has ended.
class Source {
  public:
    Source(world::World& world, const GeometryRun& run, bool needsPoints, const std::atomic<bool>& stop)
        : world_(world), run_(run), needsPoints_(needsPoints), stop_(stop) {}

    std::optional<Delivery> next() {
        next_ = std::max(next_, world_.startTick() / world_.ticksPerFrame());
        for (; next_ <= run_.lastFrame; ++next_) {
            const std::int64_t goal = next_ * world_.ticksPerFrame();
            while (world_.tick() < goal && !stop_)
                if (!advance()) return std::nullopt;
            if (stop_) return std::nullopt;
            if (run_.frameSimulated) run_.frameSimulated(next_);
            if (next_ >= run_.firstFrame) return delivery(next_++);
        }
        return std::nullopt;
    }

    const std::optional<world::Divergence>& divergence() const { return divergence_; }

    // The first tick before that of a frame, and after that of the frame before, in which something of the body broke;
    // the frame's own where nothing did.
    std::int64_t tickOf(const std::string& body, std::int64_t frame) const {
        const std::int64_t last = frame * world_.ticksPerFrame();
        const auto ticks = tears_.find(body);
        if (ticks == tears_.end()) return last;
        const auto found = ticks->second.upper_bound(last - world_.ticksPerFrame());
        return found != ticks->second.end() && found->first <= last ? found->first : last;
    }

  private:
    bool advance() {
        divergence_ = world_.advance();
        if (divergence_) return false;
        world_.registry().each<world::Identity, world::BodyPart>(
            [&](ecs::Entity, const world::Identity& identity, const world::BodyPart& part) {
                auto& ticks = tears_[identity.fullName()];
                const std::size_t known = ticks.empty() ? 0 : ticks.rbegin()->second;
                if (part.drawnDamage != known) ticks[world_.tick()] = part.drawnDamage;
            });
        return true;
    }

    Delivery delivery(std::int64_t frame) const {
        Delivery delivery{world_.view(false), {}};
        delivery.view.frame = frame;
        if (needsPoints_ && writesPoints(frame))
            for (const std::string& target : run_.targets) delivery.points.push_back(world_.points(target));
        return delivery;
    }
    bool writesPoints(std::int64_t frame) const {
        return (frame - run_.firstFrame) % run_.every == 0 || frame == run_.lastFrame;
    }

    world::World& world_;
    const GeometryRun& run_;
    bool needsPoints_;
    const std::atomic<bool>& stop_;
    std::int64_t next_ = 0;
    std::optional<world::Divergence> divergence_;
    std::map<std::string, std::map<std::int64_t, std::size_t>> tears_;  // of bodies: edges severed since a tick
};

void write(const Delivery& delivery, geometry::GeometrySink* sink, geometry::PointsWriter* points) {
    if (sink != nullptr) sink->write(delivery.view);
    if (points == nullptr || delivery.points.empty()) return;
    std::vector<geometry::PointSet> sets;
    for (const world::PointsNow& now : delivery.points) sets.push_back({now.x, now.v});
    points->write(delivery.view.frame, delivery.view.time, sets);
}

[[noreturn]] void failTorn(const geometry::TopologyChanged& torn, const Source& source, const world::World& world,
                           const GeometryRun& run) {
    const std::int64_t tick = source.tickOf(torn.name(), torn.frame());
    std::vector<std::string> advice;
    if (!run.mayTear.empty()) advice.push_back(fmt::format("write {}, where they may change", run.mayTear));
    if (torn.frame() > run.firstFrame)
        advice.push_back(fmt::format("end before it with --frames {}-{}", run.firstFrame, torn.frame() - 1));
    throw core::Error(core::ErrorKind::badContent, fmt::format("{}; it is tick {} ({:.6g} s){}{}", torn.what(), tick,
                                                               static_cast<double>(tick) * world.tickSeconds(),
                                                               advice.empty() ? "" : ": ", fmt::join(advice, ", or ")));
}

}  // namespace

bool exportGeometry(world::World& world, const GeometryRun& run, geometry::GeometrySink* sink,
                    geometry::PointsWriter* points, const std::atomic<bool>& stop) {
    TAUT_EXPECTS(world.tick() == world.startTick());
    TAUT_EXPECTS(run.firstFrame >= 0 && run.firstFrame <= run.lastFrame && run.every >= 1);
    BoundedQueue<Delivery> queue(framesWaiting);
    Source source(world, run, points != nullptr, stop);
    std::exception_ptr failure;
    std::jthread simulating([&] {
        try {
            while (std::optional<Delivery> delivery = source.next())
                if (!queue.push(std::move(*delivery))) return;
            queue.close();
        } catch (...) {
            failure = std::current_exception();
            queue.abandon();
        }
    });
    try {
        while (const std::optional<Delivery> delivery = queue.pop()) write(*delivery, sink, points);
    } catch (const geometry::TopologyChanged& torn) {
        queue.abandon();
        simulating.join();
        failTorn(torn, source, world, run);
    } catch (...) {
        queue.abandon();
        simulating.join();
        throw;
    }
    simulating.join();
    if (failure) std::rethrow_exception(failure);
    if (source.divergence()) throw core::Error(core::ErrorKind::diverged, source.divergence()->message);
    if (stop) return false;
    if (sink != nullptr) sink->finish();
    if (points != nullptr) points->finish();
    return true;
}

}  // namespace taut::pipeline
