// A world that JavaScript ticks and asks.
#pragma once

#include <memory>
#include <optional>

#include "game/web/object.h"
#include "game/web/scene_source.h"
#include "taut/check/watcher.h"
#include "taut/world/undoing_world.h"

namespace taut::web {

class WorldObject : public Object {
  public:
    explicit WorldObject(const Json& with);
    Json call(const std::string& what, const Json& with) override;

  private:
    static const Calls<WorldObject> calls;
    WorldObject(SceneSource source, scene::Loaded loaded);

    void watch();
    void step(std::int64_t ticks);
    world::Selection select(const std::string& target) const;
    Json hashes(std::int64_t ticks);
    Json moment() const;
    Json about() const;
    Json results() const;
    Json save();
    void restore(std::span<const std::byte> bytes);

    SceneSource source_;
    std::shared_ptr<const scene::ActionReader> actions_;
    scene::StateKeys keys_;
    std::vector<std::string> warnings_;
    world::UndoingWorld world_;
    std::optional<check::Watcher> watcher_;  // where the scene has claims
    std::optional<world::Divergence> divergence_;

    // The results of the last call.
    world::PointsNow points_;
    std::vector<glm::dvec3> positions_;
    std::string text_;
};

}  // namespace taut::web
