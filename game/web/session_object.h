// A scene that a page plays: with a hand for the mouse, pictures between ticks, and a record of the actions.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <optional>

#include "game/web/object.h"
#include "game/web/scene_source.h"
#include "taut/geometry/private/parts.h"
#include "taut/live/pace.h"
#include "taut/live/session.h"

namespace taut::web {

class SessionObject : public Object {
  public:
    explicit SessionObject(const Json& with);
    Json call(const std::string& what, const Json& with) override;

  private:
    static const Calls<SessionObject> calls;
    SessionObject(SceneSource source, scene::Loaded loaded);

    Json advance(double wall, double speed, double budget);
    Json step(int ticks);
    Json moment();
    Json frame(std::optional<double> share);
    Json glb(double aspect);
    Json pick(const Json& with) const;
    Json grab(const Json& with);
    void lead(const Json& with);
    void apply(const std::string& table);
    Json about() const;
    Json solver() const;
    Json rampable() const;
    Json record(const std::string& scene);
    std::optional<live::PickedPoint> pointUnder(const Json& with, bool withHeld) const;
    live::Ray rayOf(const Json& with) const;
    view::Camera cameraOf(const Json& with) const;

    // The data of a part in the page.
    struct Shown {
        std::shared_ptr<const view::Topology> topology;
        std::shared_ptr<const view::Geometry> geometry;
        glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    };

    SceneSource source_;
    std::shared_ptr<const scene::ActionReader> actions_;
    std::vector<std::string> warnings_;
    live::Session session_;
    live::Pace pace_;
    std::vector<std::string> faults_;

    geometry::PartFinder finder_{nullptr};
    std::map<std::string, Shown> shown_;  // by identifier
    std::vector<geometry::Part> parts_;   // of the last frame
    std::vector<std::byte> bytes_;        // of the last GLB

    glm::dvec3 held_{0.0}, offset_{0.0};  // [m] where the hand is, and its way there from where the ray passes
};

}  // namespace taut::web
