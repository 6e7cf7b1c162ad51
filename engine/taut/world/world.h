// A scene in motion: entities and their components, islands, the tick, and the view for a picture.
// It knows neither files nor GL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "taut/core/finding.h"
#include "taut/ecs/entity.h"
#include "taut/island/report.h"
#include "taut/world/contact_info.h"
#include "taut/world/world_info.h"

namespace taut::ecs {
class Registry;
}

namespace taut::view {
struct FrameView;
}

namespace taut::world {

struct ActionSpec;
struct BodySpec;
struct ColliderSpec;
class Force;
struct RampAction;
struct RunSpec;
struct SceneSpec;
struct WorldImpl;

struct Options {
    int threads = 0;                                     // 0: as many as the machine has
    std::vector<std::shared_ptr<const Force>> forces{};  // beyond those of the scene; steps allow for them
    bool keepsSteps = false;                             // the first tick's, to the end; else "auto" follows the state
};

class World {
  public:
    // Builds everything; throws core::Error(badContent) with file:line:column where the scene is at fault. A scene made
    // in code must satisfy spec.h. With a kept state in the scene the world goes on from it, at its tick.
    explicit World(const SceneSpec& spec, const Options& options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    double tickSeconds() const;  // [s]
    int ticksPerFrame() const;
    std::int64_t tick() const;       // how many there have been
    std::int64_t startTick() const;  // 0, or that of the kept state
    double time() const;             // [s] = tick / ticks per second, computed from whole numbers

    // Plays one tick: every island does its substeps of forces, integration and collision, side by side. If an island
    // diverges, the world keeps the state of the tick before and the diagnosis is returned; only the views may be
    // called after that. If the scene asks for freezing, an island that diverges keeps its last good state from then
    // on, the others go on, and nothing is returned. Exceptions of an action, a system or a force are passed on.
    // The tick is then half done, and nothing may be called: undoing_world.h can go back.
    std::optional<Divergence> advance();

    // Does an action now, between two ticks; advance() does the actions of the scene when their tick begins. Bodies
    // whose forces change restart their method. Throws core::Error(badContent), with the action's source, if the action
    // finds nothing to act on, such as a hand that does not exist.
    void apply(const ActionSpec& action);

    // The place of a hand [m]; none if no hand has that name.
    std::optional<glm::dvec3> handPlace(const std::string& id) const;

    // The picture of this moment; `debug` adds springs, points and contacts.
    view::FrameView view(bool debug) const;

    // The picture of a moment that is `ahead` [s] of now, or before now if negative. Everything moves on at its present
    // velocity, cameras follow their keyframes. It is meant for exposures so short that velocities hardly change. It
    // has no marks and labels.
    view::FrameView viewAhead(double ahead) const;

    std::uint64_t stateHash() const;                                 // chained over ticks
    std::vector<BodyHash> bodyHashes() const;                        // in the order of the state hash; not chained
    std::vector<std::uint64_t> pointHashes(ecs::Entity body) const;  // of x and the stored v, in order of authoring
    Metrics metrics(Measures what = Measures::all) const;
    Metrics metrics(const std::string& bodies) const;   // of the bodies that e.g. "cloth.*" names; zeros if none
    PointsNow points(const std::string& target) const;  // empty if it names none
    // A selection is valid until a body is added or removed. Expects a valid one of this world.
    Selection select(const std::string& target) const;
    bool isCurrent(const Selection& selection) const;
    Metrics metrics(const Selection& selection, Measures what = Measures::all) const;
    PointsNow points(const Selection& selection) const;
    std::vector<glm::dvec3> positions(const Selection& selection) const;  // those of points() [m], at less cost
    // (triangles) corners [m] of all the bodies' surfaces, without faces that cuts and tears removed and with faces
    // that they exposed; of rigid bodies as they are drawn.
    std::vector<std::array<glm::dvec3, 3>> triangles(const Selection& bodies) const;

    // save() returns everything that the ticks so far have changed, as bytes. restore() reads them into a world that
    // has not ticked since it was made. That world needs the same forces and a scene that is the same up to that tick;
    // later ticks of the scene may differ if they lead to the same steps. restore() throws core::Error(badContent) for
    // bytes that do not fit this world or were saved by other bits (result_bits.h); the world is unusable then.
    std::vector<std::byte> save() const;
    // `applied`: the ramps that apply() began, which no action of the scene would begin.
    void restore(std::span<const std::byte> bytes, std::span<const RampAction> applied = {});

    std::vector<IslandInfo> islands() const;
    ContactInfo contact() const;            // of bodies that touch
    std::vector<JointInfo> joints() const;  // in the order of the scene, those with colliders last
    ode::Work work() const;                 // of all methods since the start
    double asleepShare() const;             // of the points, that sleep
    // Share of the places [m] that lie within the edges of the picture, hidden or not.
    double shareInPicture(std::span<const glm::dvec3> places) const;
    bool hasTouched() const;                      // a collider or a body, since it was made or restored
    std::vector<FrozenIsland> frozen() const;     // in the order of islands()
    std::vector<core::Finding> warnings() const;  // steps over the limit, working stretch left, frozen, …

    // Entities with their components (components.h), open to new kinds: a component added here together with
    // a system below needs no change in this class.
    ecs::Registry& registry();
    const ecs::Registry& registry() const;

    // Adds a system. The world calls it at the start of every tick with the time at the end of the tick and its length
    // [s]: after it has set keyframed placements, before forces act. Systems run in the order of adding.
    using System = std::function<void(World& world, double t, double dt)>;
    // `callback` is the name of a system that is written in another language, or uses functions that differ from
    // machine to machine. With such a system equal bits on all machines are not promised.
    void addSystem(System system, const std::string& callback = {});

    // The names of such systems, and of forces that are callbacks. Equal bits are promised while there are none.
    std::vector<std::string> callbacks() const;

    // Adds a force that acts from now on, on all bodies and on those added later. Its energy counts as elastic, or as
    // gravitational if it is uniform. Steps are not chosen again: if the force is too stiff for them, warnings() says
    // so. Steps do allow for Options::forces. Throws core::Error(usage) if a force of that name already acts.
    void addForce(std::shared_ptr<const Force> force);

    // Adds a collider or a body during a run. A new body is an island of its own; the existing winds and colliders act
    // on it. Throws and expects the same as the constructor.
    ecs::Entity spawn(const ColliderSpec& spec);
    ecs::Entity spawn(const BodySpec& spec);
    // Removes the entity and its parts; points tied to a removed collider become free. Expects an entity
    // that is alive and, if it is a body, is not joined to another.
    void destroy(ecs::Entity entity);

    // The positions of a body's points in the order of authoring [m]. Expects that the entity is a body.
    std::vector<glm::dvec3> positions(ecs::Entity body) const;

  private:
    friend struct WorldAccess;
    std::unique_ptr<WorldImpl> impl_;
};

}  // namespace taut::world
