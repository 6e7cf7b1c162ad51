// A world as Python has it: made from a scene, ticked without the interpreter's lock, asked between ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "game/python/callbacks.h"
#include "game/python/painter.h"
#include "taut/pipeline/saved_state.h"
#include "taut/scene/load.h"
#include "taut/world/undoing_world.h"

namespace taut::python {

using pipeline::SavedState, pipeline::SceneSource;

// Its functions expect the interpreter's lock and throw core::Error; long ones release it meanwhile.
class LiveWorld {
  public:
    // pybind11 asks for room where an object of Python, such as World.__new__ gives, holds no world when it is used.
    static void* operator new(std::size_t size);
    LiveWorld(SceneSource source, int threads);
    // From the bytes of save(), with the scene read again.
    static std::shared_ptr<LiveWorld> from(const std::string& bytes);

    // To be asked, between two ticks or by a system. Refuses forces and energies, of whoever asks them, and other
    // threads meanwhile.
    const world::World& asked() const;
    const world::SceneSpec& spec() const { return world_.spec(); }
    const std::vector<std::string>& warnings() const { return warnings_; }  // of the scene
    // The bodies and points of a target. Refuses a target without any.
    world::Selection select(const std::string& target) const;
    void requireBodies(const std::string& target) const;  // KIND.NAME

    void step(std::int64_t ticks);
    void apply(const std::string& table);  // TOML
    void place(const std::string& collider, std::optional<glm::dvec3> position, std::optional<glm::dvec3> angles);
    collision::Pose poseOf(const std::string& collider) const;
    // Gives the force's name.
    std::string addForce(const pybind11::function& force, const std::vector<std::string>& targets,
                         const pybind11::object& energy, ForceWishes wishes);
    void addSystem(const pybind11::function& system);

    std::string save() const;
    void restore(const std::string& bytes);
    std::string pickled() const;

    image::Image draw(world::PictureSpec picture, bool debug);

    // References for Python's garbage collector, and their release.
    const std::vector<Held>& functions() const { return functions_; }

  private:
    void requireStill(const char* what) const;
    LiveWorld(SceneSource source, scene::Loaded loaded, int threads);

    using Phase = Activity::Phase;
    SceneSource source_;
    std::shared_ptr<const scene::ActionReader> actions_;
    scene::StateKeys keys_;
    std::vector<std::string> warnings_;
    world::UndoingWorld world_;
    Painter painter_;
    std::vector<Held> functions_;
    std::optional<world::Divergence> divergence_;
    std::shared_ptr<Activity> activity_ = std::make_shared<Activity>();
    std::thread::id ticker_;  // the thread that ticks it
};

}  // namespace taut::python
