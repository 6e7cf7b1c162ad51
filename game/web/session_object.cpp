#include "game/web/session_object.h"

#include <fmt/format.h>

#include <algorithm>

#include "taut/core/error.h"
#include "taut/geometry/glb_writer.h"
#include "taut/geometry/private/poses.h"
#include "taut/live/between.h"
#include "taut/live/recording.h"
#include "taut/world/world.h"

namespace taut::web {
namespace {

constexpr int mostTicks = 8;         // a picture
constexpr double longestWall = 1.0;  // [s] of a picture; after a pause there is no more to catch up

Json cameraJson(const view::Camera& camera) {
    return {{"eye", numbersOf(camera.eye)},
            {"target", numbersOf(camera.target)},
            {"up", numbersOf(camera.up)},
            {"fieldOfView", camera.fieldOfView}};
}

Json pointJson(const live::PickedPoint& point) {
    return {{"target", live::nameOf(point)},
            {"body", point.body},
            {"point", point.point},
            {"position", numbersOf(point.position)}};
}

}  // namespace

const Calls<SessionObject> SessionObject::calls{
    {"about", [](SessionObject& own, const Json&) { return own.about(); }},
    {"advance", [](SessionObject& own,
                   const Json& with) { return own.advance(with.at("wall"), with.at("speed"), with.at("budget")); }},
    {"step", [](SessionObject& own, const Json& with) { return own.step(with.at("ticks")); }},
    {"moment", [](SessionObject& own, const Json&) { return own.moment(); }},
    {"hash",
     [](SessionObject& own, const Json&) { return Json(fmt::format("{:016x}", own.session_.world().stateHash())); }},
    {"frame",
     [](SessionObject& own, const Json& with) {
         return own.frame(with.contains("share") ? std::optional<double>(with["share"]) : std::nullopt);
     }},
    {"glb", [](SessionObject& own, const Json& with) { return own.glb(with.value("aspect", 16.0 / 9.0)); }},
    {"pick", [](SessionObject& own, const Json& with) { return own.pick(with); }},
    {"grab", [](SessionObject& own, const Json& with) { return own.grab(with); }},
    {"lead",
     [](SessionObject& own, const Json& with) {
         own.lead(with);
         return Json();
     }},
    {"release",
     [](SessionObject& own, const Json&) {
         own.session_.hand().release();
         return Json();
     }},
    {"apply",
     [](SessionObject& own, const Json& with) {
         own.apply(with.at("table"));
         return Json();
     }},
    {"metrics", [](SessionObject& own, const Json&) { return measuresOf(own.session_.metrics()); }},
    {"solver", [](SessionObject& own, const Json&) { return own.solver(); }},
    {"rampable", [](SessionObject& own, const Json&) { return own.rampable(); }},
    {"record", [](SessionObject& own, const Json& with) { return own.record(with.value("scene", own.source_.file)); }},
};

SessionObject::SessionObject(const Json& with) : SessionObject(sourceIn(with), read(sourceIn(with))) {}

SessionObject::SessionObject(SceneSource source, scene::Loaded loaded)
    : source_(std::move(source)),
      actions_(loaded.actions),
      warnings_(printed(loaded.warnings)),
      session_(std::move(loaded.spec), 1),
      pace_(session_.world().tickSeconds()) {}

Json SessionObject::call(const std::string& what, const Json& with) {
    return calls.at(what)(*this, with);
}

Json SessionObject::about() const {
    const world::World& world = session_.world();
    std::vector<std::string> warnings = warnings_, bodies;
    for (std::string& warning : printed(world.warnings())) warnings.push_back(std::move(warning));
    for (const live::BodyPoints& body : session_.bodies(true)) bodies.push_back(body.name);
    return {{"tickSeconds", world.tickSeconds()},
            {"ticksPerFrame", world.ticksPerFrame()},
            {"seconds", session_.spec().run.seconds},
            {"title", session_.spec().title},
            {"bodies", bodies},
            {"warnings", warnings}};
}

Json SessionObject::advance(double wall, double speed, double budget) {
    const int due = pace_.due(std::clamp(wall, 0.0, longestWall), std::max(speed, 0.0), mostTicks);
    const std::int64_t before = session_.tick();
    session_.begin(due, budget);
    session_.wait();
    const int done = static_cast<int>(session_.tick() - before);
    pace_.owe(done < due && !session_.divergence() ? due - done : 0);
    Json all = moment();
    all["due"] = due;
    all["done"] = done;
    return all;
}

Json SessionObject::step(int ticks) {
    constexpr double unlimited = 1e9;  // [s]
    session_.begin(ticks, unlimited);
    session_.wait();
    return moment();
}

Json SessionObject::moment() {
    const world::World& world = session_.world();
    return {{"tick", world.tick()},
            {"time", world.time()},
            {"faults", session_.takeFaults()},
            {"isHolding", session_.hand().isHolding()},
            {"divergence", session_.divergence() ? divergenceOf(*session_.divergence()) : Json()}};
}

// The data of a part that the page does not have yet.
Json SessionObject::frame(std::optional<double> share) {
    const view::FrameView view =
        live::between(session_.before(), session_.now(), std::clamp(share.value_or(pace_.share()), 0.0, 1.0));
    parts_ = finder_.partsOf(view);
    Json parts = Json::array();
    bool fits = true;
    for (const geometry::Part& part : parts_) {
        const auto found = shown_.find(part.identifier);
        fits = fits && found != shown_.end();
        if (!fits) break;
        Shown& shown = found->second;
        shown.rotation = geometry::rotationIn(part.transform, shown.rotation);
        const glm::quat& q = shown.rotation;
        Json one{{"name", part.identifier},
                 {"translation", numbersOf(glm::vec3(part.transform[3]))},
                 {"rotation", {q.x, q.y, q.z, q.w}}};
        if (shown.topology != part.topology) {
            one["triangles"] = arrayOf(std::span<const std::uint32_t>(part.topology->triangles), "Uint32Array");
            one["uv"] = vectorsOf(std::span<const glm::vec2>(part.topology->uv));
        }
        if (shown.geometry != part.geometry) {
            one["positions"] = vectorsOf(std::span<const glm::vec3>(part.geometry->positions));
            one["normals"] = vectorsOf(std::span<const glm::vec3>(part.geometry->normals));
        }
        shown.topology = part.topology;
        shown.geometry = part.geometry;
        parts.push_back(std::move(one));
    }
    return {{"time", view.time}, {"camera", cameraJson(view.camera)}, {"fits", fits}, {"parts", parts}};
}

// The present state, as `taut export` writes it.
Json SessionObject::glb(double aspect) {
    geometry::GeometryOptions options;
    options.fps = session_.spec().run.fps;
    options.aspect = aspect;
    options.generator = "taut " TAUT_VERSION;
    geometry::GlbWriter writer("scene.glb", options);
    writer.write(session_.now());
    bytes_.clear();
    writer.finish([&](std::span<const std::byte> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); });

    finder_ = geometry::PartFinder(nullptr);
    shown_.clear();
    for (const geometry::Part& part : finder_.partsOf(session_.now()))
        shown_[part.identifier] = Shown{part.topology, part.geometry};
    return bytesOf(bytes_);
}

view::Camera SessionObject::cameraOf(const Json& with) const {
    view::Camera camera = session_.now().camera;
    if (!with.contains("camera")) return camera;
    const Json& given = with["camera"];
    if (given.contains("eye")) camera.eye = vectorIn<glm::vec3>(given["eye"]);
    if (given.contains("target")) camera.target = vectorIn<glm::vec3>(given["target"]);
    if (given.contains("up")) camera.up = vectorIn<glm::vec3>(given["up"]);
    camera.fieldOfView = given.value("fieldOfView", camera.fieldOfView);
    return camera;
}

live::Ray SessionObject::rayOf(const Json& with) const {
    return live::rayThrough(cameraOf(with), {with.at("x"), with.at("y")}, with.at("aspect"));
}

std::optional<live::PickedPoint> SessionObject::pointUnder(const Json& with, bool withHeld) const {
    return live::pick(rayOf(with), session_.now().surfaces, session_.bodies(withHeld), live::pickReach);
}

Json SessionObject::pick(const Json& with) const {
    const auto picked = pointUnder(with, true);
    return picked ? pointJson(*picked) : Json();
}

Json SessionObject::grab(const Json& with) {
    const auto picked = pointUnder(with, false);
    if (!picked) return {};
    session_.grab(*picked);
    held_ = picked->position;
    offset_ = picked->position - live::onPicturePlane(rayOf(with), cameraOf(with), picked->position);
    return pointJson(*picked);
}

void SessionObject::lead(const Json& with) {
    held_ = live::onPicturePlane(rayOf(with), cameraOf(with), held_ - offset_) + offset_;
    session_.hand().leadTo(held_);
}

void SessionObject::apply(const std::string& table) {
    session_.apply(*actions_->read(table, session_.nextTime(), "apply()", session_.spec()));
}

Json SessionObject::solver() const {
    double step = session_.world().tickSeconds();
    for (const world::IslandInfo& island : session_.world().islands()) step = std::min(step, island.step);
    return {{"method", session_.spec().solver.integrator}, {"step", step}};
}

Json SessionObject::rampable() const {
    Json all = Json::array();
    for (const scene::Rampable& field : actions_->rampable(session_.spec()))
        all.push_back({{"key", field.key},
                       {"unit", field.unit},
                       {"low", field.range.low},
                       {"high", field.range.high},
                       {"value", field.value}});
    return all;
}

Json SessionObject::record(const std::string& scene) {
    if (session_.divergence()) throw core::Error(core::ErrorKind::diverged, "a run that diverged is not recorded");
    live::Recording recording = session_.record();
    recording.scene = scene;
    recording.overrides = source_.overrides;
    return {{"text", live::scenarioText(recording)},
            {"hash", fmt::format("{:016x}", recording.hash)},
            {"tick", recording.endTick},
            {"deeds", recording.deeds.size()}};
}

}  // namespace taut::web
