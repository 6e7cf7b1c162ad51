// A scene in motion: entities and their components, islands, the tick, and the view for a picture.
// It knows neither files nor GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
    std::vector<std::shared_ptr<const Force>> forces{};  // besides those of the scene; steps allow for them
    bool keepsSteps = false;  // those of the first tick to the last; else "auto" follows the state
};

class World {
  public:
    // Builds everything; throws core::Error(badContent) with file:line:column where the scene is at fault. Of a scene
    // made in code it expects what spec.h says.
    explicit World(const SceneSpec& spec, const Options& options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    double tickSeconds() const;  // [s]
    int ticksPerFrame() const;
    std::int64_t tick() const;  // how many there have been
    double time() const;        // [s] = tick / ticks per second, computed from whole numbers

    // One tick: forces, integration, collision, substeps times for every island, side by side. On divergence the
    // state of the tick before is kept and the diagnosis returned; nothing else may be called then but the views.
    // Where the scene asks for freezing, an island that diverges keeps its last good state from then on, the others go
    // on, and nothing is returned. Throws what an action, a system or a force throws; nothing may be called then, for
    // the tick is half done: undoing_world.h goes back.
    std::optional<Divergence> advance();

    // Does it now, between two ticks; advance() does so with the actions of the scene when their tick begins. Bodies
    // whose forces change restart their method. Throws core::Error(badContent), with the action's source, for one that
    // finds nothing to act on, such as a hand that is not there.
    void apply(const ActionSpec& action);

    // Where a hand is [m]; none if there is no hand of that name.
    std::optional<glm::dvec3> handPlace(const std::string& id) const;

    // The picture of this moment; with springs, points and contacts where debug.
    view::FrameView view(bool debug) const;

    // The same of a moment `ahead` [s] of now, or before it, for exposures that are short against how motion changes:
    // everything goes on evenly as it does now, cameras as their keyframes say. Without marks and labels.
    view::FrameView viewAhead(double ahead) const;

    std::uint64_t stateHash() const;                                 // chained over ticks
    std::vector<BodyHash> bodyHashes() const;                        // in the order of the state hash; not chained
    std::vector<std::uint64_t> pointHashes(ecs::Entity body) const;  // of x and the stored v, in the order of authoring
    Metrics metrics(Measures what = Measures::all) const;
    Metrics metrics(const std::string& bodies) const;   // of those that "cloth.*" names; zeros where it names none
    PointsNow points(const std::string& target) const;  // empty where it names none
    // A selection serves until a body comes or goes; expects one that is current, of this world.
    Selection select(const std::string& target) const;
    bool isCurrent(const Selection& selection) const;
    Metrics metrics(const Selection& selection, Measures what = Measures::all) const;
    PointsNow points(const Selection& selection) const;
    std::vector<glm::dvec3> positions(const Selection& selection) const;  // as points() has them [m], at less cost

    // Everything that the ticks so far have changed, as bytes, and back into a world that was built from the same scene
    // up to that tick, with the same forces, and has not ticked yet; what a scene says of later ticks may differ as
    // long as it leads to the same steps. restore() throws core::Error(badContent) for bytes that do not fit this
    // world or were saved by other bits (result_bits.h), and leaves it unusable then.
    std::vector<std::byte> save() const;
    // `applied` are ramps that apply() began and no action of the scene would.
    void restore(std::span<const std::byte> bytes, std::span<const RampAction> applied = {});

    std::vector<IslandInfo> islands() const;
    ContactInfo contact() const;                // of bodies that touch
    std::vector<JointInfo> joints() const;      // in the order of the scene, those with colliders last
    ode::Work work() const;                     // of all methods since the start
    bool hasTouched() const;                    // anything, a collider or a body, since it was made or restored
    std::vector<FrozenIsland> frozen() const;   // in the order of islands()
    std::vector<std::string> warnings() const;  // steps over the limit, working stretch left, frozen, …

    // Entities with their components (components.h), open to new kinds of both: a component added here together with
    // a system below needs no change in this class.
    ecs::Registry& registry();

    // Called at the start of every tick with the time at its end and its length [s], after keyframed placements are
    // set and before forces act; in the order of adding.
    using System = std::function<void(World& world, double t, double dt)>;
    // `callback` names a system that is written in another language, or computes with what differs from machine to
    // machine, so that nobody promises that bits are the same everywhere.
    void addSystem(System system, const std::string& callback = {});

    // Names of such systems, and of forces that are callbacks. Equal bits are promised while there are none.
    std::vector<std::string> callbacks() const;

    // A force acts from now on, on the bodies that are there and on those that come; its energy counts among the
    // elastic ones, or among the gravitational where it is uniform. Steps are not chosen anew: where it is too stiff
    // for them, warnings() says so; Options::forces are allowed for. Throws core::Error(usage) where one of that name
    // acts already.
    void addForce(std::shared_ptr<const Force> force);

    // In mid-run. A new body is an island of its own, felt by the winds and colliders that are there. Throws and
    // expects what the constructor does.
    ecs::Entity spawn(const ColliderSpec& spec);
    ecs::Entity spawn(const BodySpec& spec);
    // Removes the entity and what it stood for; a collider lets go of what is tied to it. Expects that it is alive, and
    // a body not joined to another.
    void destroy(ecs::Entity entity);

    // Positions of a body's points in the order of authoring [m]; expects an entity that is one.
    std::vector<glm::dvec3> positions(ecs::Entity body) const;

  private:
    friend struct WorldAccess;
    std::unique_ptr<WorldImpl> impl_;
};

}  // namespace taut::world
