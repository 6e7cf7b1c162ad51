#include "taut/advice/private/pins.h"

#include "taut/spec/targets.h"
#include "taut/world/private/impl.h"

namespace taut::world {
namespace {

// The points of a plan on which a force acts from outside the body.
class Loads {
  public:
    Loads(const IslandPlan& plan, const Body& body, const SceneSpec& scene)
        : body_(body), isLoaded_(plan.points.size(), false), isOwn_(plan.points.size(), false) {
        for (const int i : body.pointOf) isOwn_[i] = true;
        for (std::size_t i = 0; i < plan.points.size(); ++i) isLoaded_[i] = plan.points[i].held;
        for (const Grip& grip : plan.grips)
            for (const int i : grip.points) add(i);
        for (std::size_t s = 0; s < plan.springs.size(); ++s) {
            if (plan.origins[s].body >= 0) continue;
            add(plan.springs[s].a);
            add(plan.springs[s].b);
        }
        for (const Body* other : plan.bodies)
            if (other != &body)
                for (const int i : other->pointOf) add(i);
        for (const MassSpec& mass : scene.masses)
            if (names(mass.target, body))
                for (const int i : selectPoints(body.model, parseTarget(mass.target).selector)) add(body.pointOf[i]);
    }

    // The first point of the model with a load while its neighbours have none, or -1.
    int firstAlone() const {
        std::vector<bool> isAlone = isLoaded_;
        for (const mechanics::Spring& s : body_.model.springs) {
            if (s.kind != mechanics::SpringKind::structural) continue;
            const auto a = static_cast<std::size_t>(body_.pointOf[s.a]),
                       b = static_cast<std::size_t>(body_.pointOf[s.b]);
            if (isLoaded_[a] && isLoaded_[b]) isAlone[a] = isAlone[b] = false;
        }
        for (std::size_t i = 0; i < body_.pointOf.size(); ++i)
            if (isAlone[body_.pointOf[i]]) return static_cast<int>(i);
        return -1;
    }

  private:
    void add(int point) {
        const auto i = static_cast<std::size_t>(point);
        if (isOwn_[i]) isLoaded_[i] = true;
    }

    const Body& body_;
    std::vector<bool> isLoaded_, isOwn_;  // (points of the plan)
};

}  // namespace

void RehearsedPins::look(World& world) {
    const WorldImpl& w = WorldAccess::of(world);
    for (const auto& island : w.islands)
        for (const Body* body : island->plan().bodies) {
            const bool mayGiveWay = body->plasticity.breakStrain || body->plasticity.yieldStrain;
            const bool isLine = body->model.triangles.empty() && body->model.cells.empty();
            if (!mayGiveWay || isLine || seen_.count(body->fullName()) > 0) continue;
            const int point = Loads(island->plan(), *body, *w.start).firstAlone();
            if (point < 0) continue;
            seen_.insert(body->fullName());
            warnings_.push_back(warningAt({}) + body->fullName() + " is held or loaded at a single point, " + "#" +
                                std::to_string(point) + ": the strain beside it grows as cells shrink, so when it " +
                                (body->plasticity.breakStrain ? "tears" : "yields") +
                                " there depends on their number; take several neighbouring points, an edge, or a grab "
                                "with a radius");
        }
}

}  // namespace taut::world
