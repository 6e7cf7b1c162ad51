#include "game/python/live_world.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "game/python/errors.h"
#include "game/python/folders.h"
#include "taut/spec/private/rotation.h"
#include "taut/world/components.h"

namespace py = pybind11;

namespace taut::python {
namespace {

scene::Loaded read(const SceneSource& source) {
    const py::gil_scoped_release free;
    scene::LoadOptions options;
    options.overrides = source.overrides;
    options.isConfined = source.isConfined;
    options.stateIn = pipeline::stateIn;
    if (const std::filesystem::path assets = assetFolder(); !assets.empty()) options.assetFolders.push_back(assets);
    if (source.isText) return scene::loadSceneText(source.text, source.file, options);
    return scene::loadScene(sceneFile(source.file), options);
}

world::Options optionsFor(int threads) {
    world::Options options;
    options.threads = threads;
    return options;
}

}  // namespace

void* LiveWorld::operator new(std::size_t) {
    refuse("this World holds no scene; worlds are made by taut.load() and taut.loads()");
}

LiveWorld::LiveWorld(SceneSource source, int threads) : LiveWorld(source, read(source), threads) {}

LiveWorld::LiveWorld(SceneSource source, scene::Loaded loaded, int threads)
    : source_(std::move(source)),
      actions_(loaded.actions),
      keys_(loaded.keys),
      warnings_(printed(loaded.warnings)),
      world_(std::move(loaded.spec), optionsFor(threads)) {
    source_.file = lastingName(source_.file, source_.isText);
}

std::shared_ptr<LiveWorld> LiveWorld::from(const std::string& bytes) {
    const SceneSource source = pipeline::fromBytes(bytes).source;
    const char* remedy =
        "\n"
        "a pickle reads its scene again: put that back where it was, or load() it and restore() the bytes of save()";
    try {
        auto world = std::make_shared<LiveWorld>(source, 0);
        remedy = "";  // restore() has its own
        world->restore(bytes);
        return world;
    } catch (const core::Error& error) {
        throw core::Error(error.kind(), fmt::format("this pickle's scene: {}{}", error.what(), remedy));
    }
}

const world::World& LiveWorld::asked() const {
    if (activity_->asking > 0)
        refuse(
            "this world is asking a force or an energy of Python and is not to be used until that has answered; it has "
            "t, x, v and mass to go by");
    const bool isAllowed = activity_->phase == Phase::still ||
                           (activity_->phase == Phase::inSystem && ticker_ == std::this_thread::get_id());
    if (!isAllowed)
        refuse("this world is in the middle of a tick; a force has t, x, v and mass, others may ask between two steps");
    return world_.world();
}

void LiveWorld::requireStill(const char* what) const {
    (void)asked();
    if (activity_->phase != Phase::still) refuse(fmt::format("a system may not {} the world that calls it", what));
}

world::Selection LiveWorld::select(const std::string& target) const {
    world::Selection selection = asked().select(target);
    const bool isEmpty = std::all_of(selection.parts.begin(), selection.parts.end(),
                                     [](const auto& part) { return part.points.empty(); });
    if (!isEmpty) return selection;
    const std::string fault = scene::targetFault(spec(), target, true);
    refuse(!fault.empty() ? fault : fmt::format("{} is not there, or not yet", target));
}

void LiveWorld::requireBodies(const std::string& target) const {
    if (const std::string fault = scene::targetFault(spec(), target, false); !fault.empty()) refuse(fault);
}

// Without the lock; checks every 50 ms for an interruption by the user.
void LiveWorld::step(std::int64_t ticks) {
    using Clock = std::chrono::steady_clock;
    if (ticks < 0) refuse(fmt::format("a world cannot go {} ticks back; restore() the bytes of save()", -ticks));
    requireStill("step");
    if (divergence_) throw DivergedError(*divergence_);
    struct Ticking {
        Phase& phase;
        ~Ticking() { phase = Phase::still; }
    } ticking{activity_->phase};
    activity_->phase = Phase::inTick;
    ticker_ = std::this_thread::get_id();
    const py::gil_scoped_release free;
    auto looked = Clock::now();
    for (std::int64_t i = 0; i < ticks && !divergence_; ++i) {
        divergence_ = world_.advance();
        if (Clock::now() - looked < std::chrono::milliseconds(50)) continue;
        looked = Clock::now();
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    if (divergence_) throw DivergedError(*divergence_);
}

void LiveWorld::apply(const std::string& table) {
    const world::World& now = asked();
    if (divergence_) throw DivergedError(*divergence_);
    world_.apply(*actions_->read(table, now.time(), "apply()", spec()));
}

void LiveWorld::place(const std::string& collider, std::optional<glm::dvec3> position,
                      std::optional<glm::dvec3> angles) {
    (void)asked();
    collision::Pose pose = world_.poseOf(collider);
    if (position) pose.position = *position;
    if (angles) pose.rotation = world::rotationOf(*angles);
    world_.place(collider, pose);
}

collision::Pose LiveWorld::poseOf(const std::string& collider) const {
    (void)asked();
    return world_.poseOf(collider);
}

std::string LiveWorld::addForce(const py::function& force, const std::vector<std::string>& targets,
                                const py::object& energy, ForceWishes wishes) {
    requireStill("add a force to");
    for (const std::string& target : targets)
        if (const std::string fault = scene::targetFault(spec(), target, true); !fault.empty()) refuse(fault);
    for (const double bound : {wishes.stiffness, wishes.dampingRate})
        if (!(bound >= 0) || !std::isfinite(bound))
            refuse("stiffness and damping_per_s are bounds for the step: they must be finite and not negative");
    wishes.targets = targets;
    const Held own = held(force), ownEnergy = energy.is_none() ? Held() : held(energy);
    world_.addForce(pythonForce(wishes, own, ownEnergy, activity_));
    functions_.push_back(own);
    if (ownEnergy) functions_.push_back(ownEnergy);
    return wishes.name;
}

void LiveWorld::addSystem(const py::function& system) {
    const Held own = held(system);
    const std::string name = py::hasattr(system, "__name__") ? std::string(py::str(system.attr("__name__"))) : "system";
    requireStill("add a system to");  // now that no code of Python is asked any more
    const auto call = [this, own, name](world::World&, double t, double dt) {
        const py::gil_scoped_acquire lock;
        struct Asking {
            Phase& phase;
            ~Asking() { phase = Phase::inTick; }
        } asking{activity_->phase};
        activity_->phase = Phase::inSystem;
        try {
            (*own)(py::cast(this, py::return_value_policy::reference), t, dt);
        } catch (py::error_already_set& error) {
            addNote(error, fmt::format("in the system {} of the tick to {:.6g} s, which is undone", name, t));
            throw;
        }
    };
    world_.addSystem(call, "system " + name);
    functions_.push_back(own);
}

std::string LiveWorld::save() const {
    const world::World& now = asked();
    if (activity_->phase != Phase::still)
        refuse("a system may not save the world that calls it; save it between two steps");
    SavedState state;
    state.source = source_;
    state.key = keys_.stateAt(now.tick());
    state.tick = now.tick();
    for (const world::RampAction& ramp : world_.applied()) state.ramps.push_back(ramp.key);
    state.files = scene::usedFiles(spec());
    for (scene::UsedFile& file : state.files) file.path = lastingName(file.path, false);
    state.world = now.save();
    return pipeline::toBytes(state);
}

void LiveWorld::restore(const std::string& bytes) {
    requireStill("restore");
    const SavedState state = pipeline::fromBytes(bytes);
    if (state.key != keys_.stateAt(state.tick)) {
        std::string changes;
        for (const std::string& change : scene::changedSince(state.files))
            changes += (changes.empty() ? ": " : ", ") + change;
        throw core::Error(core::ErrorKind::badContent,
                          "these bytes are of another scene, or of something else that happens before their tick" +
                              changes + "; load the scene with the same overrides");
    }
    std::vector<world::RampAction> ramps;
    for (const std::string& key : state.ramps) ramps.push_back(actions_->ramp(key, spec()));
    world_.restore(state.world, std::move(ramps));
    divergence_.reset();
}

std::string LiveWorld::pickled() const {
    if (!functions_.empty())
        refuse(
            "a world with forces or systems of Python cannot be pickled, for pickles hold state alone; pickle save(), "
            "and restore() it in a world with the same functions");
    return save();
}

image::Image LiveWorld::draw(world::PictureSpec picture, bool debug) {
    view::FrameView view = asked().view(debug);
    if (!picture.camera.empty()) {
        std::optional<view::Camera> found;
        std::string names;
        asked().registry().each<world::CameraPart>([&](ecs::Entity, const world::CameraPart& part) {
            names += (names.empty() ? "" : ", ") + part.spec.name;
            if (part.spec.name == picture.camera) found = world::cameraOf(part, view.time);
        });
        if (!found)
            refuse(fmt::format("there is no camera \"{}\"; {}", picture.camera,
                               names.empty() ? "the scene has none" : "there are " + names));
        view.camera = *found;
    }
    const py::gil_scoped_release free;
    return painter_.draw(view, picture);
}

}  // namespace taut::python
