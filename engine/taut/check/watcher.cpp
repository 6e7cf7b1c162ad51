#include "taut/check/watcher.h"

#include <fmt/format.h>

#include <cmath>

#include "taut/check/private/evaluation.h"
#include "taut/core/error.h"
#include "taut/spec/spec.h"
#include "taut/spec/ticks.h"
#include "taut/world/world.h"

namespace taut::check {

namespace {

std::string spanText(const world::CheckSpec& spec) {
    if (spec.at) return fmt::format("at {:.6g} s", *spec.at);
    if (spec.from && spec.upTo) return fmt::format("from {:.6g} s to {:.6g} s", *spec.from, *spec.upTo);
    if (spec.from) return fmt::format("from {:.6g} s on", *spec.from);
    if (spec.upTo) return fmt::format("up to {:.6g} s", *spec.upTo);
    return "always";
}

// Whether one outcome is worse than another; NaN is worst.
bool isWorse(const Outcome& a, const Outcome& b) {
    if (a.holds != b.holds) return b.holds;
    return !std::isnan(b.margin) && !(a.margin >= b.margin);
}

std::string failureText(const Sighting& first) {
    const Outcome& outcome = first.outcome;
    const std::string place = first.where.empty() ? "" : fmt::format(", {}", first.where);
    return fmt::format("{} is {}, not {} {}, at {}{}", outcome.subject, quantityText(outcome.value, outcome.unit),
                       outcome.relation, quantityText(outcome.bound, outcome.unit), momentText(first), place);
}

}  // namespace

std::string momentText(const Sighting& sighting) {
    return fmt::format("{:.6g} s, frame {}", sighting.time, sighting.frame);
}

std::string quantityText(double value, const std::string& unit) {
    return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit);
}

Watcher::Watcher(const world::SceneSpec& scene) {
    const world::Ticks ticks(scene.run);
    ticksPerSecond_ = ticks.perSecond;
    lastTick_ = ticks.last();
    for (const world::CheckSpec& spec : scene.checks) {
        Watched watched;
        try {
            watched.check = spec.parsed ? *spec.parsed : Check::parse(spec.that);
        } catch (const ClaimError& fault) {
            throw core::Error(core::ErrorKind::badContent, at(spec.source) + fault.what());
        }
        watched.spec = spec;
        watched.begin = spec.at ? ticks.at(*spec.at) : spec.from ? ticks.at(*spec.from) : 0;
        watched.end = spec.at ? watched.begin : spec.upTo ? ticks.at(*spec.upTo) : lastTick_;
        watched.result.that = spec.that;
        watched.result.source = spec.source;
        watched.result.span = spanText(spec);
        watched_.push_back(std::move(watched));
    }
}

void Watcher::look(const world::World& world) {
    const Now now(world, selections_);
    for (Watched& watched : watched_) {
        if (world.tick() < watched.begin || world.tick() > watched.end) continue;
        lookAt(watched, now);
    }
}

void Watcher::lookAt(Watched& watched, const Now& now) {
    const world::World& world = now.world();
    Result& result = watched.result;
    const std::int64_t perFrame = world.ticksPerFrame();
    Sighting sighting{
        world.tick(), (world.tick() + perFrame - 1) / perFrame, world.time(), watched.check.evaluate(now), {}};
    ++result.looks;
    watched.last = world.tick();
    if (!sighting.outcome.holds) ++result.failures;
    // The place is looked for only once: it costs as much as the evaluation.
    if (!sighting.outcome.holds && !result.first) {
        sighting.where = watched.check.where(now);
        result.first = sighting;
    }
    if (!result.worst || isWorse(sighting.outcome, result.worst->outcome)) result.worst = std::move(sighting);
}

std::vector<Result> Watcher::results() const {
    std::vector<Result> results;
    for (const Watched& watched : watched_) {
        Result& result = results.emplace_back(watched.result);
        const bool isComplete = watched.last >= watched.end;
        result.passed = isComplete && result.failures == 0;
        if (result.first) {
            result.reason = failureText(*result.first);
        } else if (result.looks == 0) {
            result.reason =
                fmt::format("its moment, {:.6g} s, never came", static_cast<double>(watched.begin) / ticksPerSecond_);
        } else if (!isComplete) {
            result.reason = fmt::format("the run ended at {:.6g} s, before {:.6g} s",
                                        static_cast<double>(watched.last) / ticksPerSecond_,
                                        static_cast<double>(watched.end) / ticksPerSecond_);
        }
    }
    return results;
}

}  // namespace taut::check
