#include "taut/study/plan_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "taut/bodies/block.h"
#include "taut/bodies/cloth.h"
#include "taut/bodies/rope.h"
#include "taut/body/body.h"
#include "taut/core/error.h"
#include "taut/core/private/contains.h"
#include "taut/core/private/stopwatch.h"
#include "taut/ecs/registry.h"
#include "taut/spec/spec.h"
#include "taut/spec/ticks.h"
#include "taut/view/camera_axes.h"
#include "taut/world/components.h"
#include "taut/world/world.h"

namespace taut::study {
namespace {

using glm::dvec3;

// Places of a body that is compared over resolutions: the ends of so many equal parts of each edge.
constexpr int partsOfRope = 24, partsOfCloth = 12, partsOfBlock = 5;

// The fixed cost of a call of the forces, in springs (measured on nets of a few springs: 100 ns against 1 to 2).
constexpr double costOfCall = 60;

// The cost of a detection of contact between bodies per point, and per pair that it looks at, in springs
// (measured on a hanging cloth, one that folds and a pile of four: 120 ns, and 0.6 to 1.3 us, against 2 ns).
constexpr double costOfDetection = 60, costOfPair = 400;

// The cost of a run before its first tick, to build the world and choose the step, in springs (measured: 0.5 ms and 1
// to 2 us for each spring).
constexpr double costOfStart = 1e5, callsOfStart = 300;

// A place as points and their weights.
struct Place {
    std::array<int, 8> points{};
    std::array<double, 8> weights{};
    int count = 0;
};

// The cell and the share of it at a fraction of an edge.
struct Along {
    int cell;
    double share;
};
Along along(int part, int parts, int cells) {
    const double at = static_cast<double>(part) / parts * cells;
    const int cell = std::min(static_cast<int>(at), cells - 1);
    return {cell, at - cell};
}

// Linear, bilinear or trilinear between the points of a grid, the first edge running fastest; edges included.
std::vector<Place> placesOfGrid(const std::array<int, 3>& cells, const std::array<int, 3>& parts) {
    std::vector<Place> places;
    for (int k = 0; k <= parts[2]; ++k)
        for (int j = 0; j <= parts[1]; ++j)
            for (int i = 0; i <= parts[0]; ++i) {
                const std::array<int, 3> part{i, j, k};
                Place place;
                for (int corner = 0; corner < 8; ++corner) {
                    int point = 0, stride = 1;
                    double weight = 1;
                    for (std::size_t d = 0; d < 3; ++d) {
                        const bool isFar = (corner >> d & 1) != 0;
                        const Along at = cells[d] > 0 ? along(part[d], parts[d], cells[d]) : Along{0, 0.0};
                        point += stride * (at.cell + (isFar ? 1 : 0));
                        weight *= isFar ? at.share : 1 - at.share;
                        stride *= cells[d] + 1;
                    }
                    if (weight <= 0) continue;
                    place.points[place.count] = point;
                    place.weights[place.count++] = weight;
                }
                places.push_back(place);
            }
    return places;
}

std::vector<Place> freePoints(const mechanics::Model& model) {
    std::vector<Place> places;
    for (int i = 0; i < model.pointCount(); ++i)
        if (!model.held[i]) places.push_back({{i}, {1.0}, 1});
    return places;
}

class Watcher {
  public:
    Watcher(world::World& world, const Resolution& resolution) : world_(world) {
        world.registry().each<world::BodyPart>([&](ecs::Entity entity, const world::BodyPart& part) {
            bodies_.push_back({entity, placesOf(*part.body, resolution)});
        });
    }

    Sight look() const {
        Sight sight;
        for (const auto& [entity, places] : bodies_) {
            const std::vector<dvec3> positions = world_.positions(entity);
            for (const Place& place : places) {
                dvec3 x(0.0);
                for (std::size_t i = 0; i < static_cast<std::size_t>(place.count); ++i)
                    x += place.weights[i] * positions[place.points[i]];
                sight.push_back(x);
            }
        }
        return sight;
    }

  private:
    static std::vector<Place> placesOf(const world::Body& body, const Resolution& resolution) {
        const std::string name = body.spec->fullName();
        const auto& scalable = resolution.scalable;
        if (!core::contains(scalable, name)) return freePoints(body.model);
        if (body.kind() == world::ClothSpec::kindName)
            return placesOfGrid({body.model.grid[0], body.model.grid[1], 0}, {partsOfCloth, partsOfCloth, 0});
        if (body.kind() == world::RopeSpec::kindName)
            return placesOfGrid({body.model.pointCount() - 1, 0, 0}, {partsOfRope, 0, 0});
        if (const auto* block = dynamic_cast<const world::BlockSpec*>(body.spec.get()))
            return placesOfGrid({block->cells.x, block->cells.y, block->cells.z},
                                {partsOfBlock, partsOfBlock, partsOfBlock});
        return freePoints(body.model);
    }

    world::World& world_;
    std::vector<std::pair<ecs::Entity, std::vector<Place>>> bodies_;
};

// Of contact between bodies so far.
double contactCost(const world::World& world) {
    const world::ContactInfo contact = world.contact();
    return costOfDetection * static_cast<double>(contact.detections) * contact.points +
           costOfPair * static_cast<double>(contact.testedPairs);
}

// The cost so far, with `more` added to each evaluation and product.
double costSoFar(const world::World& world, double more = 0) {
    double sum = contactCost(world);
    for (const world::IslandInfo& island : world.islands())
        sum += (costOf(island) + more) * static_cast<double>(island.work.evaluations + island.work.iterations);
    return sum;
}

// Size of a pixel at the nearest of these places before the camera. [m] 0 when none is.
double pixelAt(const world::World& world, const world::SceneSpec& model, const Sight& sight) {
    const view::Camera camera = world.view(false).camera;
    const dvec3 ahead = glm::normalize(dvec3(camera.target) - dvec3(camera.eye));
    double nearest = HUGE_VAL;
    for (const dvec3& x : sight) {
        const double depth = glm::dot(x - dvec3(camera.eye), ahead);
        if (depth > static_cast<double>(camera.nearPlane)) nearest = std::min(nearest, depth);
    }
    const double height = 2 * std::tan(0.5 * static_cast<double>(verticalField(camera, model.picture.size)));
    return nearest < HUGE_VAL ? nearest * height / model.picture.size.y : 0.0;
}

// RMS over the places of the first looks. [m]
double differenceOf(const PlanRun& a, const PlanRun& b, std::size_t samples) {
    double sum = 0, count = 0;
    for (std::size_t s = 0; s < samples; ++s)
        for (std::size_t i = 0; i < a.at[s].size(); ++i) {
            const dvec3 apart = a.at[s][i] - b.at[s][i];
            sum += glm::dot(apart, apart);
            ++count;
        }
    return std::sqrt(sum / std::max(count, 1.0));
}

class SightBounds {
  public:
    void add(const Sight& sight) {
        for (const dvec3& x : sight) least_ = glm::min(least_, x), most_ = glm::max(most_, x);
    }
    double diagonal() const { return most_.x < least_.x ? 0.0 : glm::length(most_ - least_); }

  private:
    dvec3 least_{HUGE_VAL}, most_{-HUGE_VAL};
};

void advance(world::World& world, const world::SceneSpec& model, const Resolution& resolution, const PlanGrid& grid,
             const RunLimits& limits, PlanRun& run) {
    const Watcher watcher(world, resolution);
    const double atStart = costSoFar(world);
    const bool bodiesTouch = world::bodiesTouch(model);
    double costOfAll = 0;
    for (const world::IslandInfo& island : world.islands()) costOfAll += costOf(island);
    SightBounds box;
    if (limits.withScales) box.add(watcher.look());
    // Islands are described from scratch at each call: rarely.
    const auto isTooExpensive = [&] {
        const ode::Work work = world.work();
        const double most = (costOfAll + costOfCall) * static_cast<double>(work.evaluations + work.iterations) +
                            (bodiesTouch ? contactCost(world) : 0.0);
        return most > std::min(limits.cost, limits.effort) &&
               (costSoFar(world) - atStart > limits.cost || costSoFar(world, costOfCall) > limits.effort);
    };
    for (int sample = 0; sample < grid.samples; ++sample) {
        const core::Stopwatch watch;
        for (int tick = 0; tick < grid.every && run.failure.empty() && !run.isTooExpensive; ++tick) {
            if (const auto divergence = world.advance())
                run.failure = "diverged at " + std::to_string(divergence->time) + " s";
            const bool isLast = sample + 1 == grid.samples && tick + 1 == grid.every;
            run.isTooExpensive = !isLast && run.failure.empty() && isTooExpensive();
        }
        run.seconds += watch.seconds();
        if (!run.hasEnded()) return;
        run.at.push_back(watcher.look());
        const Sight& seen = run.at.back();
        if (limits.withScales) {
            box.add(seen);
            run.scales.extent = box.diagonal();
            const double pixel = pixelAt(world, model, seen);
            if (pixel > 0 && (run.scales.metresPerPixel == 0 || pixel < run.scales.metresPerPixel))
                run.scales.metresPerPixel = pixel;
        }
    }
}

}  // namespace

PlanGrid planGrid(const world::SceneSpec& spec, double horizon) {
    PlanGrid grid;
    const world::Ticks tickings(spec.run);
    grid.ticksPerFrame = tickings.perFrame;
    grid.tick = 1.0 / tickings.perSecond;
    const int ticks = std::max(1, static_cast<int>(std::llround(horizon / grid.tick)));
    grid.every = std::max(1, ticks / 10);
    while (ticks % grid.every != 0) --grid.every;  // the last look is at the horizon itself
    grid.samples = ticks / grid.every;
    return grid;
}

PlanRun play(const world::SceneSpec& model, const Resolution& resolution, const PlanGrid& grid,
             const RunLimits& limits) {
    PlanRun run;
    try {
        world::World world(model, {.threads = 1});
        for (const world::IslandInfo& island : world.islands()) {
            run.springs += island.springs;
            if (island.substeps <= run.substeps) continue;
            run.substeps = island.substeps;
            run.step = island.step;
        }
        const double atStart = costSoFar(world);
        double ofStart = costOfStart;
        for (const world::IslandInfo& island : world.islands()) ofStart += callsOfStart * costOf(island);
        advance(world, model, resolution, grid, limits, run);
        run.work = world.work();
        run.cost = costSoFar(world) - atStart;
        run.startEffort = ofStart;
        run.effort = ofStart + costSoFar(world, costOfCall);
        run.hasContacts = world.hasTouched();
    } catch (const core::Error& error) {
        if (error.kind() != core::ErrorKind::badContent) throw;
        run.failure = "no step: unstable for all, or more than a million a tick";
    }
    return run;
}

double difference(const PlanRun& a, const PlanRun& b) {
    return a.hasEnded() && b.hasEnded() && !a.at.empty() ? differenceOf(a, b, a.at.size()) : HUGE_VAL;
}

int samplesWithin(const PlanRun& a, const PlanRun& b, double most) {
    const std::size_t samples = std::min(a.at.size(), b.at.size());
    std::size_t within = 0;
    while (within < samples && differenceOf(a, b, within + 1) <= most) ++within;
    return static_cast<int>(within);
}

}  // namespace taut::study
