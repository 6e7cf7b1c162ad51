#include "taut/study/scene_subject.h"

#include <algorithm>
#include <cmath>

#include "taut/core/error.h"
#include "taut/ecs/registry.h"
#include "taut/ode/method_table.h"
#include "taut/spec/spec.h"
#include "taut/study/fehlberg78.h"
#include "taut/study/one_method.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

constexpr double longestStudied = 2.0;  // [s] studied of a scene unless asked for more

world::SceneSpec played(const world::SceneSpec& spec, std::string_view method, Precision precision, double step,
                        double shift) {
    world::SceneSpec scene = byMethod(spec, method, precision, shift);
    scene.solver.dt = atMost(step);
    return scene;
}

// In place, or on a collider.
bool isHeld(const world::Body& body, std::size_t point) {
    return body.model.held[point] || std::ranges::binary_search(body.carried, static_cast<int>(point));
}

bool hasFreePoint(world::World& world) {
    bool has = false;
    world.registry().each<world::BodyPart>([&](ecs::Entity, const world::BodyPart& part) {
        for (std::size_t i = 0; i < part.body->model.held.size() && !has; ++i) has = !isHeld(*part.body, i);
    });
    return has;
}

class SceneTrial final : public Trial {
  public:
    SceneTrial(const world::SceneSpec& scene, long long ticksPerSample)
        : world_(scene, {.threads = 1}), ticksPerSample_(ticksPerSample) {}

    bool advance() override {
        for (long long i = 0; i < ticksPerSample_; ++i)
            if (world_.advance()) return false;
        return true;
    }

    Observation observe() override {
        Observation seen;
        world_.registry().each<world::BodyPart>([&](ecs::Entity entity, const world::BodyPart& part) {
            const std::vector<glm::dvec3> positions = world_.positions(entity);
            for (std::size_t i = 0; i < positions.size(); ++i)
                for (int p = 0; p < 3 && !isHeld(*part.body, i); ++p) seen.values.push_back(positions[i][p]);
        });
        const world::Metrics metrics = world_.metrics(world::Measures::butCrossings);
        seen.kinetic = metrics.kinetic;
        seen.energy = metrics.energy();
        seen.hasTouched = world_.hasTouched();
        return seen;
    }

    ode::Work work() const override { return world_.work(); }

  private:
    world::World world_;
    long long ticksPerSample_;
};

class SceneSubject final : public Subject {
  public:
    SceneSubject(const world::SceneSpec& spec, std::string name)
        : spec_(spec), name_(std::move(name)), title_(spec.title.empty() ? name_ : spec.title) {
        world::World world(played(spec, "leapfrog", Precision::double_, 1.0, 0.0), {.threads = 1});
        tick_ = world.tickSeconds();
        if (!hasFreePoint(world))
            throw core::Error(core::ErrorKind::badContent,
                              core::at({spec.file}) + "nothing in the scene can move: it has no point that is free");
    }

    const std::string& name() const override { return name_; }
    const std::string& title() const override { return title_; }
    int dimensions() const override { return 3; }
    std::string unit() const override { return "m"; }
    bool hasEnergy() const override { return true; }
    double duration() const override { return std::min(spec_.run.seconds, longestStudied); }
    bool accepts(const ode::MethodInfo&) const override { return true; }

    Grid grid(double duration, double window) const override {
        const auto ticks = std::max(10LL, std::llround(duration / tick_));
        const auto each = std::max(1LL, static_cast<long long>(std::min(window, duration) / tick_ / 10 + 1e-6));
        return {tick_ * static_cast<double>(each), static_cast<int>(ticks / each)};
    }
    long long quantum(const Grid& grid) const override { return std::llround(grid.spacing / tick_); }

    std::unique_ptr<Trial> begin(const RunPlan& plan) const override {
        world::SceneSpec scene = played(spec_, plan.method, plan.precision, plan.step(), plan.perturbation);
        scene.solver.methods = referenceMethods();
        scene.solver.cgTolerance = plan.tolerance > 0 ? plan.tolerance : plan.solverShare * scene.solver.cgTolerance;
        return std::make_unique<SceneTrial>(scene, quantum(plan.grid));
    }

    double stepLimit(const ode::MethodInfo& method) const override {
        const world::World world(played(spec_, method.name, Precision::double_, tick_, 0.0),
                                 {.threads = 1, .keepsSteps = true});
        double limit = HUGE_VAL;
        for (const world::IslandInfo& island : world.islands()) limit = std::min(limit, island.stepLimit);
        return limit;
    }

    double frame() const override { return 1.0 / spec_.run.fps; }

    std::string caution() const override {
        return spec_.colliders.empty() && !world::bodiesTouch(spec_)
                   ? ""
                   : "Contacts are of order 1 in the step for any method.";
    }

  private:
    world::SceneSpec spec_;
    std::string name_, title_;
    double tick_ = 0;
};

}  // namespace

std::unique_ptr<Subject> makeSceneSubject(const world::SceneSpec& spec, const std::string& name) {
    return std::make_unique<SceneSubject>(spec, name);
}

}  // namespace taut::study
