#include "game/web/world_object.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"

namespace taut::web {
namespace {

std::string hashText(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

[[noreturn]] void refuse(const std::string& message) {
    throw core::Error(core::ErrorKind::usage, message);
}

}  // namespace

const Calls<WorldObject> WorldObject::calls{
    {"about", [](WorldObject& own, const Json&) { return own.about(); }},
    {"step",
     [](WorldObject& own, const Json& with) {
         own.step(with.at("ticks"));
         return own.moment();
     }},
    {"moment", [](WorldObject& own, const Json&) { return own.moment(); }},
    {"hash", [](WorldObject& own, const Json&) { return Json(hashText(own.world_.world().stateHash())); }},
    {"hashes", [](WorldObject& own, const Json& with) { return own.hashes(with.at("ticks")); }},
    {"positions",
     [](WorldObject& own, const Json& with) {
         own.positions_ = own.world_.world().positions(own.select(with.at("target")));
         return vectorsOf(std::span<const glm::dvec3>(own.positions_));
     }},
    {"points",
     [](WorldObject& own, const Json& with) {
         own.points_ = own.world_.world().points(own.select(with.at("target")));
         return Json{{"positions", vectorsOf(std::span<const glm::dvec3>(own.points_.x))},
                     {"velocities", vectorsOf(std::span<const glm::dvec3>(own.points_.v))},
                     {"masses", arrayOf(std::span<const double>(own.points_.mass), "Float64Array")}};
     }},
    {"apply",
     [](WorldObject& own, const Json& with) {
         if (own.divergence_) throw core::Error(core::ErrorKind::diverged, own.divergence_->message);
         own.world_.apply(
             *own.actions_->read(with.at("table"), own.world_.world().time(), "apply()", own.world_.spec()));
         return Json();
     }},
    {"metrics",
     [](WorldObject& own, const Json& with) {
         const std::string bodies = with.value("bodies", "");
         if (bodies.empty()) return measuresOf(own.world_.world().metrics());
         if (const std::string fault = scene::targetFault(own.world_.spec(), bodies, false); !fault.empty())
             refuse(fault);
         return measuresOf(own.world_.world().metrics(bodies));
     }},
    {"save", [](WorldObject& own, const Json&) { return own.save(); }},
    {"restore",
     [](WorldObject& own, const Json& with) {
         own.restore(bytesIn(with));
         return Json();
     }},
    {"check", [](WorldObject& own, const Json&) { return own.results(); }},
};

WorldObject::WorldObject(const Json& with) : WorldObject(sourceIn(with), read(sourceIn(with))) {}

WorldObject::WorldObject(SceneSource source, scene::Loaded loaded)
    : source_(std::move(source)),
      actions_(loaded.actions),
      keys_(loaded.keys),
      warnings_(printed(loaded.warnings)),
      world_(std::move(loaded.spec), {.threads = 1}) {
    watch();
}

// The scene's claims, from now on.
void WorldObject::watch() {
    if (world_.spec().checks.empty()) return;
    watcher_.emplace(world_.spec());
    watcher_->look(world_.world());
}

Json WorldObject::call(const std::string& what, const Json& with) {
    return calls.at(what)(*this, with);
}

void WorldObject::step(std::int64_t ticks) {
    if (ticks < 0) refuse(fmt::format("a world cannot go {} ticks back; restore() the bytes of save()", -ticks));
    for (std::int64_t i = 0; i < ticks; ++i) {
        if (!divergence_) divergence_ = world_.advance();
        if (divergence_) throw core::Error(core::ErrorKind::diverged, divergence_->message);
        if (watcher_) watcher_->look(world_.world());
    }
}

Json WorldObject::hashes(std::int64_t ticks) {
    Json all = Json::array();
    for (std::int64_t i = 0; i < ticks; ++i) {
        step(1);
        all.push_back(hashText(world_.world().stateHash()));
    }
    return all;
}

world::Selection WorldObject::select(const std::string& target) const {
    world::Selection selection = world_.world().select(target);
    const bool isEmpty = std::all_of(selection.parts.begin(), selection.parts.end(),
                                     [](const auto& part) { return part.points.empty(); });
    if (!isEmpty) return selection;
    const std::string fault = scene::targetFault(world_.spec(), target, true);
    refuse(!fault.empty() ? fault : fmt::format("{} is not there, or not yet", target));
}

Json WorldObject::moment() const {
    return {{"tick", world_.world().tick()}, {"time", world_.world().time()}};
}

Json WorldObject::about() const {
    const world::World& world = world_.world();
    Json bodies = Json::array();
    for (const world::BodyHash& body : world.bodyHashes()) bodies.push_back(body.name);
    std::vector<std::string> warnings = warnings_;
    for (std::string& warning : printed(world.warnings())) warnings.push_back(std::move(warning));
    return {{"tickSeconds", world.tickSeconds()},
            {"ticksPerFrame", world.ticksPerFrame()},
            {"seconds", world_.spec().run.seconds},
            {"title", world_.spec().title},
            {"bodies", bodies},
            {"warnings", warnings}};
}

Json WorldObject::save() {
    const world::World& world = world_.world();
    pipeline::SavedState state;
    state.source = source_;
    state.key = keys_.stateAt(world.tick());
    state.tick = world.tick();
    for (const world::RampAction& ramp : world_.applied()) state.ramps.push_back(ramp.key);
    state.files = scene::usedFiles(world_.spec());
    state.world = world.save();
    text_ = pipeline::toBytes(state);
    return bytesOf(std::as_bytes(std::span<const char>(text_)));
}

void WorldObject::restore(std::span<const std::byte> bytes) {
    const pipeline::SavedState state = pipeline::fromBytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (state.key != keys_.stateAt(state.tick))
        throw core::Error(core::ErrorKind::badContent,
                          "these bytes are of another scene, or of one with other actions before their tick; load the "
                          "scene with the same overrides");
    std::vector<world::RampAction> ramps;
    for (const std::string& key : state.ramps) ramps.push_back(actions_->ramp(key, world_.spec()));
    world_.restore(state.world, std::move(ramps));
    divergence_.reset();
    watch();
}

Json WorldObject::results() const {
    Json all = Json::array();
    if (!watcher_) return all;
    for (const check::Result& result : watcher_->results())
        all.push_back({{"that", result.that},
                       {"span", result.span},
                       {"passed", result.passed},
                       {"looks", result.looks},
                       {"failures", result.failures},
                       {"reason", result.reason}});
    return all;
}

}  // namespace taut::web
